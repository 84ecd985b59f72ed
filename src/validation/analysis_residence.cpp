#include "validation/analysis_residence.h"

#include <fmt/format.h>

#include <cmath>

#include "analysis/residence.h"
#include "base/random.h"

namespace sluice {

void AnalysisResidence::keys(Schema& s) {
  s.integer("particles", particles, {.at_least = 10, .doc = "that leave"});
}

namespace {
constexpr std::uint64_t draws = 20;

/// Sum of squared deviations from what is expected, over the draws.
struct Scatter {
  double squares = 0;
  void add(double deviation) { squares += deviation * deviation; }
  double rms() const { return std::sqrt(squares / draws); }
};
}  // namespace

Measured AnalysisResidence::run(const CsvTable& reference) const {
  const std::vector<double> tanks = reference_numbers(reference, "tanks");
  const std::vector<double> variance = reference_numbers(reference, "variance");
  const std::vector<double> before_mean = reference_numbers(reference, "before_mean");
  Measured out;
  for (std::size_t k = 0; k < tanks.size(); ++k) {
    Scatter of_mean, of_variance, of_share;
    for (std::uint64_t draw = 0; draw < draws; ++draw) {
      Random random(23, draws * k + draw);
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
      of_mean.add(r.mean - 1);
      of_variance.add(r.variance / (r.mean * r.mean) - variance[k]);
      of_share.add(early / all - before_mean[k]);
      out.particle_steps += static_cast<double>(particles);
    }
    const std::string where = fmt::format(", {} tanks", tanks[k]);
    out.values.push_back({"deviation of the mean" + where, of_mean.rms(), 0, 1});
    out.values.push_back(
        {"deviation of the variance over mean squared" + where, of_variance.rms(), 0, variance[k]});
    out.values.push_back({"deviation of the share before the mean" + where, of_share.rms(), 0, 1});
  }
  return out;
}

}  // namespace sluice
