#pragma once
/// Sieving of rocks drawn by number from a size distribution by mass, over the number of rocks.
///
/// Reference: columns `sieve` [mm], `passing` (share of mass), coarse to fine; rocks begin at the finest.

#include "validation/measure.h"

namespace sluice {

struct AnalysisSizes : Measure {
  std::int64_t rocks = 1000;

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
