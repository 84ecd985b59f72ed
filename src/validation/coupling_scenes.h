#pragma once
/// Rocks in water for the measures.

#include "coupling/coupling.h"
#include "validation/water_scenes.h"

namespace sluice {

struct ImmersedSetup {
  WaterSetup water;
  CouplingConfig coupling;
  double rock_density = 2700;  ///< [kg/m3]
  double rock_size = 0.01;     ///< [m]
  RockShape rock_shape = make_sphere();
  PairProperties pair{0.5, 0.5, 0};
  std::optional<Vec3> rock_gravity;  ///< instead of the water's [m/s2]
};

/// A WaterScene with rocks that feel it, and that it feels.
class ImmersedScene {
 public:
  ImmersedScene(const ImmersedSetup& setup, std::vector<Wall> walls);
  /// One fluid step, with the rocks' substeps.
  void step();

  WaterScene fluid;
  std::unique_ptr<DemSystem> rocks;
  std::unique_ptr<Coupling> coupling;
  double exchanged = 0;  ///< sum of |impulse| over rocks and steps [N s]
};

}  // namespace sluice
