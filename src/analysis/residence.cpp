#include "analysis/residence.h"

#include <limits>

#include "analysis/confidence.h"

namespace sluice {

ResidenceTimes residence_times(const std::vector<double>& times, const std::vector<double>& masses) {
  constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
  double mass = 0, moment = 0, square = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    mass += masses[i];
    moment += masses[i] * times[i];
  }
  if (mass <= 0) return {not_known, not_known, not_known, not_known, not_known, not_known};
  ResidenceTimes r;
  r.mean = moment / mass;
  for (std::size_t i = 0; i < times.size(); ++i)
    square += masses[i] * (times[i] - r.mean) * (times[i] - r.mean);
  r.variance = square / mass;
  r.t10 = weighted_quantile(times, masses, 0.1);
  r.t50 = weighted_quantile(times, masses, 0.5);
  r.t90 = weighted_quantile(times, masses, 0.9);
  r.tanks = r.variance > 0 ? r.mean * r.mean / r.variance : not_known;
  return r;
}

ResidenceTimes residence_times(const ExitTally& tally, double from, double to) {
  std::vector<double> times, masses;
  const RockRecord& rocks = tally.rocks();
  for (std::size_t i = 0; i < rocks.count(); ++i) {
    if (rocks.t[i] < from || rocks.t[i] >= to) continue;
    times.push_back(rocks.residence[i]);
    masses.push_back(rocks.mass[i]);
  }
  return residence_times(times, masses);
}

}  // namespace sluice
