#pragma once
/// What rocks gain, water loses: momentum of a closed periodic box with rocks on the move, over their number.
///
/// Reference: column `residual`, one row: 0.

#include "mpm/mpm_system.h"
#include "validation/measure.h"

namespace sluice {

struct CouplingThirdLaw : Measure {
  std::int64_t rocks = 100;
  std::int64_t steps = 1000;
  Precision precision = Precision::reference;

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
