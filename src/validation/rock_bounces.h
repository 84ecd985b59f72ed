#pragma once
/// Heights of a ball that bounces, over its stiffness.
///
/// Reference: columns `restitution`, `bounce`, `apex` (height above contact at rest on the floor [m]).

#include "validation/measure.h"

namespace sluice {

struct RockBounces : Measure {
  double stiffness_per_size = 1e6;  ///< [N/m2]
  double size = 0.2;                ///< [m]
  double drop = 0.4;                ///< [m]
  double steps_per_contact = 1000;

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
