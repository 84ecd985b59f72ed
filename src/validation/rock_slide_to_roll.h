#pragma once
/// A sphere that starts to slide and ends up rolling, over its stiffness.
///
/// Reference: columns `friction`, `speed0` [m/s], `roll_time` [s], `roll_speed` [m/s], `roll_place` [m]:
/// when sliding ends, how fast and where.

#include "validation/measure.h"

namespace sluice {

struct RockSlideToRoll : Measure {
  double stiffness_per_size = 5e6;  ///< [N/m2]
  double size = 0.02;               ///< [m]
  double steps_per_contact = 30;
  double seconds = 0.5;  ///< at which speed and place are read [s]

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
