#pragma once
/// A turbulent sheet that runs down an incline, over its thickness in cells.
///
/// Reference: column `speed_ratio`, mean speed over sqrt(8 g d sin(slope) / f), which is 1: weight along the
/// slope against the film stress rho f/8 u^2 of its bed.

#include "validation/measure.h"

namespace sluice {

struct WaterFilm : Measure {
  double cells = 1;         ///< across the sheet
  double thickness = 0.01;  ///< [m]
  double slope = 0.17453;   ///< [rad]
  double friction = 0.025;  ///< Darcy f
  double seconds = 3;       ///< the last quarter counts [s]

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
