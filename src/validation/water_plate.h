#pragma once
/// A round jet that meets a plate, over cells across the bore.
///
/// Reference, a row a quantity: `quantity` and `value`. `force` is that on the plate, across it, over
/// rho V^2 A; `forward` the share of the water that leaves to the side the jet points to; `stagnation` the
/// largest pressure over rho V^2 / 2; `sound` the force with sound twice as fast over the force.

#include <numbers>

#include "validation/measure.h"

namespace sluice {

struct WaterPlate : Measure {
  double cells = 4;                     ///< across the bore
  double bore = 0.08;                   ///< [m]
  double speed = 2;                     ///< [m/s]
  double angle = std::numbers::pi / 2;  ///< between jet and plate [rad]
  double passes = 16;                   ///< bores that the jet runs; the last half is read

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
