#pragma once
/// Terminal speed of one rock in still water, over the grid's spacing.
///
/// Reference: columns `diameter` [m], `density`, `fluid_density` [kg/m3], `viscosity` [Pa s], `speed` [m/s],
/// all with the drag law of Schiller and Naumann.

#include "coupling/coupling.h"
#include "validation/measure.h"

namespace sluice {

struct CouplingSettling : Measure {
  double spacing_diameters = 4;  ///< grid spacing over the rock's diameter
  CouplingMode mode = CouplingMode::two_way;
  DragModel drag = DragModel::schiller_naumann;
  double depth = 0.8;  ///< of the water [m]

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
