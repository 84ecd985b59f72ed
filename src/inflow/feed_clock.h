#pragma once
/// What a constant rate owes: rate x time between a start and a stop.

#include <algorithm>
#include <limits>

namespace sluice {

struct FeedClock {
  double rate = 0;                                        ///< [kg/s]
  double start = 0;                                       ///< [s]
  double stop = std::numeric_limits<double>::infinity();  ///< [s]

  /// Mass asked for up to time t [kg].
  double requested(double t) const { return rate * std::max(0.0, std::min(t, stop) - start); }
  /// Time at which the mass asked for reaches `mass` [s].
  double time_of(double mass) const { return start + mass / rate; }
};

/// A mass as both the single and the double path of a fluid store it [kg].
double stored_mass(double mass);

}  // namespace sluice
