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

  WallLoad& operator+=(const WallLoad& other) {
    impulse += other.impulse;
    angular_impulse += other.angular_impulse;
    sliding_energy += other.sliding_energy;
    impact_energy += other.impact_energy;
    return *this;
  }
};

}  // namespace sluice
