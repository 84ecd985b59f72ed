#pragma once
/// A rigid body that a fluid meets as a wall that moves: a rock much larger than the fluid's spacing.

#include "base/pose.h"

namespace sluice {

/// Superquadric |x/a|^m + |y/b|^m + |z/c|^m <= 1 about the centre of its poses.
struct FluidBody {
  Vec3 semi_axes = Vec3::Zero();  ///< [m]
  double blockiness = 2;          ///< m
  double reach = 0;               ///< bounding radius [m]
  Pose now, next;                 ///< at the start and the end of the fluid's step
  Twist last, twist;              ///< in the step before and in this one
};

/// What a body received in the fluid's last step.
struct BodyLoad {
  Vec3 impulse = Vec3::Zero();          ///< [N s]
  Vec3 angular_impulse = Vec3::Zero();  ///< about where its centre was at the start of the step [N m s]
};

}  // namespace sluice
