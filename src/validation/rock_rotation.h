#pragma once
/// Free rotation of an ellipsoid against the exact motion of Euler's top, over the time step.
///
/// Reference: columns `case`, `t` [s], `wx`, `wy`, `wz` in the body's frame [rad/s]; the first row of a
/// case is its start. The body is an ellipsoid of semi-axes 30, 20 and 10 mm.

#include "validation/measure.h"

namespace sluice {

struct RockRotation : Measure {
  double time_step = 1e-3;  ///< [s]

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
