#pragma once
/// A tank that tilts and stands: where its water comes to rest, and the work that it took.
///
/// Reference: rows `along` and `up` (shift of the water's centroid in the tank's own axes, over the tank's
/// length) and `work` (of the walls, over weight times length).

#include "validation/measure.h"

namespace sluice {

struct WaterTilted : Measure {
  double cells = 16;      ///< along the tank
  double angle = 0.2618;  ///< [rad]
  double seconds = 1.6;   ///< that the tilting takes; twice that is run

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
