#include "validation/analysis_residence.h"

#include <fmt/format.h>

#include <cmath>

#include "analysis/residence.h"
#include "base/random.h"

namespace sluice {

void AnalysisResidence::keys(Schema& s) {
  s.integer("particles", particles, {.at_least = 10, .doc = "that leave"});
}

Measured AnalysisResidence::run(const CsvTable& reference) const {
  const std::vector<double> tanks = reference_numbers(reference, "tanks");
  const std::vector<double> variance = reference_numbers(reference, "variance");
  const std::vector<double> before_mean = reference_numbers(reference, "before_mean");
  Measured out;
  for (std::size_t k = 0; k < tanks.size(); ++k) {
    Random random(23, k);
    std::vector<double> times, masses;
    double early = 0, all = 0;
    for (std::int64_t n = 0; n < particles; ++n) {
      double t = 0;
      for (int tank = 0; tank < static_cast<int>(tanks[k]); ++tank)
        t -= std::log(1 - random.uniform()) / tanks[k];
      times.push_back(t);
      masses.push_back(random.uniform(0.5, 1.5));
      all += masses.back();
      early += t < 1 ? masses.back() : 0;
    }
    const ResidenceTimes r = residence_times(times, masses);
    const std::string where = fmt::format(", {} tanks", tanks[k]);
    out.values.push_back({"mean" + where, r.mean, 1, 1});
    out.values.push_back(
        {"variance over mean squared" + where, r.variance / (r.mean * r.mean), variance[k], variance[k]});
    out.values.push_back({"share before the mean" + where, early / all, before_mean[k], 1});
    out.particle_steps += static_cast<double>(particles);
  }
  return out;
}

}  // namespace sluice
