#pragma once
/// Moments of residence times drawn for stirred tanks in series, over the number of particles.
///
/// Reference: columns `tanks`, `variance` (over mean^2), `before_mean` (share that leaves before the mean).

#include "validation/measure.h"

namespace sluice {

struct AnalysisResidence : Measure {
  std::int64_t particles = 1000;

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
