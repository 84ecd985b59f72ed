#pragma once
/// Lacey's index of a mixture drawn at random, which is 1 on average, over the number of cells.
///
/// Reference: columns `share`, `grains` (in each cell), `lacey`.

#include "validation/measure.h"

namespace sluice {

struct AnalysisMixing : Measure {
  std::int64_t cells = 100;

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
