#pragma once
/// From when on a run is steady, or why it is not.
///
/// The start comes from MSER (White 1997): the cut that minimises the squared standard error of what is left,
/// sought in the first half. What is left must then be long enough and flat: 10 residence times, 20 batches
/// each longer than 5 correlation times, no trend.

#include <optional>
#include <string>
#include <vector>

namespace sluice {

/// One series in equal slots of time, beginning at time 0.
struct SteadySignal {
  std::string name;  ///< "rock out", for the reason
  std::vector<double> values;
};

struct SteadyState {
  std::optional<double> from;  ///< start of the steady part [s]
  std::string reason;          ///< why there is none; empty otherwise
};

/// @param interval  of the slots [s];  @param residence_time  mean time in the box [s]; 0 = not known
SteadyState find_steady_state(const std::vector<SteadySignal>& signals, double interval,
                              double residence_time);

/// Cut by MSER over batches of five values: values to drop, at most half.
std::size_t mser_cut(const std::vector<double>& values);
/// Integrated correlation time, in slots: 1/2 + sum of the autocorrelations up to the first below 0.
double correlation_time(const std::vector<double>& values);

}  // namespace sluice
