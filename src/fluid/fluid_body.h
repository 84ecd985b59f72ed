#pragma once
/// A rigid body that a fluid meets as a wall that moves: a rock much larger than the fluid's spacing.

#include <cstdint>

#include "geometry/tri_mesh.h"
#include "geometry/wall_motion.h"

namespace sluice {

struct FluidBody {
  const TriMesh* shape = nullptr;  ///< closed, about the origin, of size 1; must last until it is replaced
  double size = 0;                 ///< [m]
  double reach = 0;                ///< no part of it is farther from its centre [m]
  Pose now, next;                  ///< at the start and the end of the fluid's step
  Twist last, twist;               ///< in the step before and in this one
};

/// What a body received in the fluid's last step.
struct BodyLoad {
  Vec3 impulse = Vec3::Zero();          ///< [N s]
  Vec3 angular_impulse = Vec3::Zero();  ///< about where its centre was at the start of the step [N m s]
};

}  // namespace sluice
