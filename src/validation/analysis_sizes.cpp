#include "validation/analysis_sizes.h"

#include <fmt/format.h>

#include "inflow/size_distribution.h"

namespace sluice {

void AnalysisSizes::keys(Schema& s) {
  s.integer("rocks", rocks, {.at_least = 10, .doc = "that are drawn and sieved"});
}

Measured AnalysisSizes::run(const CsvTable& reference) const {
  const std::vector<double> sieve = reference_numbers(reference, "sieve");
  const std::vector<double> passing = reference_numbers(reference, "passing");
  SizeDistributionConfig config;
  for (std::size_t k = sieve.size(); k-- > 0;) config.points.push_back({1e-3 * sieve[k], passing[k]});
  config.cutoff = 1e-3 * sieve.back();
  const SizeDistribution sizes(config);
  Random random(31);
  std::vector<double> mass(sieve.size());  // that passes each sieve
  double all = 0;
  for (std::int64_t n = 0; n < rocks; ++n) {
    const double d = sizes.draw(random), m = d * d * d;
    all += m;
    for (std::size_t k = 0; k < sieve.size(); ++k) mass[k] += d < 1e-3 * sieve[k] ? m : 0;
  }
  Measured out;
  out.particle_steps = static_cast<double>(rocks);
  const double fines = passing.back();
  for (std::size_t k = 1; k + 1 < sieve.size(); ++k)
    out.values.push_back({fmt::format("share of rock below {} mm", sieve[k]), mass[k] / all,
                          (passing[k] - fines) / (1 - fines), 1});
  return out;
}

}  // namespace sluice
