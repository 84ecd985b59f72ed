#pragma once
/// Fast water that comes into a level, smooth channel, over cells in its depth: nothing turns or brakes it,
/// so depth and speed stay.
///
/// Reference: column `place`, distance from the inlet over the depth.

#include "validation/measure.h"

namespace sluice {

struct WaterLaunder : Measure {
  double cells = 4;    ///< in the depth
  double depth = 0.1;  ///< [m]
  double speed = 3;    ///< faster than waves go, or they would run back to the inlet [m/s]
  double seconds = 1;  ///< the last half counts [s]

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
