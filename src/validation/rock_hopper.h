#pragma once
/// Discharge of a flat-bottomed cylinder through a round opening, against Beverloo's law.
///
///   W = C rho_b sqrt(g) (D - k d)^(5/2)
///
/// rho_b is measured in the bed above the opening while it flows. Reference: columns `C`, `k`.

#include "validation/measure.h"

namespace sluice {

struct RockHopper : Measure {
  double opening = 8;  ///< over the balls' diameter
  double size = 0.01;  ///< [m]
  double friction = 0.5;
  double bed_openings = 2.5;    ///< height of the fill over the opening
  double width_openings = 2.5;  ///< diameter of the cylinder over the opening
  double settle = 0.4;          ///< before counting [s]
  double seconds = 0.6;         ///< of counting [s]

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
