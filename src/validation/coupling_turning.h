#pragma once
/// A rod that is let go nearly lengthwise in a still liquid which does not feel it: how it turns broadside,
/// swings beyond and comes back, over the grid's spacing.
///
/// Reference: columns `time` [s], `angle` [rad] between the way down and the rod's axis.

#include "coupling/coupling.h"
#include "validation/measure.h"

namespace sluice {

struct CouplingTurning : Measure {
  double spacing_diameters = 4;  ///< grid spacing over the rod's thickness
  double thickness = 0.01;       ///< [m]
  double elongation = 3;
  double density = 2700, fluid_density = 1000;  ///< [kg/m3]
  double viscosity = 0.01;                      ///< of the liquid [Pa s]
  double tilt = 0.3;                            ///< at first [rad]
  double depth = 0.45;                          ///< of the liquid [m]

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
