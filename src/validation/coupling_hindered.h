#pragma once
/// Settling speed of a cloud of rocks in water over that of one alone, over the grid's spacing.
///
/// Rocks fall in a container with a floor; those between sediment and front are read. What counts is the
/// slip between rock and water and the concentration where they are: v = (1 - phi) slip is the speed in a
/// container at rest, and whatever water rises meanwhile drops out. Reference: columns `concentration`
/// (solid volume at the start), `exponent` of (1 - phi).

#include "coupling/coupling.h"
#include "validation/measure.h"

namespace sluice {

struct CouplingHindered : Measure {
  double spacing_diameters = 4;  ///< grid spacing over the rocks' diameter
  DragModel drag = DragModel::di_felice;
  double size = 0.01;     ///< [m]
  double depth = 0.8;     ///< of the water [m]
  double width = 0.16;    ///< periodic [m]
  double settle = 0.2;    ///< before speeds are read [s]
  double seconds = 0.25;  ///< for which they are read [s]

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

/// Speed at which drag balances weight less buoyancy [m/s].
double terminal_speed(DragModel drag, double diameter, double density, const FluidModel& fluid,
                      double gravity);

}  // namespace sluice
