#pragma once
/// What a wall received.

#include "base/vec.h"

namespace sluice {

/// Impulse and work that one wall received since the run began, from one phase.
struct WallLoad {
  Vec3 impulse = Vec3::Zero();          ///< [N s]
  Vec3 angular_impulse = Vec3::Zero();  ///< about the origin [N m s]
  double sliding_energy = 0;            ///< friction work, the shear wear of Archard and SIEM [J]
  double impact_energy = 0;             ///< dissipated in the normal direction [J]
};

}  // namespace sluice
