#pragma once
/// A resolved sphere that settles in a closed tank of viscous liquid: its greatest speed.
///
/// The tank is 100 x 100 x 160 mm, the sphere 15 mm and released with its lowest point 120 mm above the floor
/// (ten Cate et al. 2002). Still liquid carries the same with its weight or without, so that gravity acts on
/// the sphere alone, less its buoyancy: the sound need not be faster than the sphere asks.
///
/// Reference: columns `density` [kg/m3], `viscosity` [Pa s] of the liquid, `touchdown` [s], `fastest` [m/s].

#include "coupling/coupling.h"
#include "validation/measure.h"

namespace sluice {

struct CouplingSphere : Measure {
  double size_cells = 6;  ///< of the sphere

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
