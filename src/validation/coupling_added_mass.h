#pragma once
/// A resolved sphere pulled through liquid from rest: what it weighs more for the liquid that it takes along.
///
/// The liquid is ideal but for the scheme, fills a periodic box of four diameters and slips along the sphere;
/// a force acts on the sphere alone. Read is the mean acceleration over a twentieth of a diameter, v^2 / 2s.
///
/// Reference: columns `ratio` (of the densities) and `acceleration` (over that of the force on the sphere
/// alone).

#include "validation/measure.h"

namespace sluice {

struct CouplingAddedMass : Measure {
  double size_cells = 6;  ///< of the sphere

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
