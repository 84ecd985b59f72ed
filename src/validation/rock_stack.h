#pragma once
/// Two balls squeezed between floor and ceiling, against the exact solution of the coupled oscillators,
/// over the time step. The set-up is DEM03 of the MFIX tests.
///
/// Reference: columns `t` [s], `y1`, `y2` [m]; the first row is the start.

#include "validation/measure.h"

namespace sluice {

struct RockStack : Measure {
  double time_step = 1e-5;  ///< [s]

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
