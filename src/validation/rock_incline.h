#pragma once
/// Acceleration of one rock on an incline, from rest: a ball that rolls or slips, a block that sticks or
/// slides. Gravity is tilted and the floor stays level, so that only the physics changes.
/// The acceleration is read from the way: a block that stays put still rocks on its face.
///
/// Reference: columns `angle` [deg], `friction`, `acceleration` [m/s2] of the centre and, for balls,
/// `spin` (R x angular acceleration [m/s2]).

#include "validation/measure.h"

namespace sluice {

struct RockIncline : Measure {
  double stiffness_per_size = 5e6;  ///< [N/m2]
  double size = 0.02;               ///< [m]
  double blockiness = 2;            ///< 2 = ball, 8 and more = block
  double steps_per_contact = 30;
  double seconds = 0.3;  ///< [s]

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
