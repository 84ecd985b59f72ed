#pragma once
/// How long things stay: moments of a residence time distribution.

#include <vector>

#include "analysis/exits.h"

namespace sluice {

/// NaN where nothing left.
struct ResidenceTimes {
  double mean = 0;                   ///< [s]
  double variance = 0;               ///< [s2]
  double t10 = 0, t50 = 0, t90 = 0;  ///< times by which that share of the mass had left [s]
  double tanks = 0;  ///< stirred tanks in series with the same spread: mean^2 / variance (Levenspiel 1999)
};

/// @param times  [s];  @param masses  weights, any unit
ResidenceTimes residence_times(const std::vector<double>& times, const std::vector<double>& masses);
/// Of the rocks that left between `from` and `to` [s].
ResidenceTimes residence_times(const ExitTally& tally, double from, double to);

}  // namespace sluice
