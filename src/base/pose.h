#pragma once
/// Where a rigid body is and how it moves.

#include "base/vec.h"

namespace sluice {

/// Where a body is that rests in its own frame: turned about `centre`, which has moved to `at`.
struct Pose {
  Quat q = Quat::Identity();   ///< rest to space
  Vec3 centre = Vec3::Zero();  ///< rest frame [m]
  Vec3 at = Vec3::Zero();      ///< [m]
  Vec3 to_space(const Vec3& rest) const { return at + q * (rest - centre); }
  Vec3 to_rest(const Vec3& x) const { return centre + q.conjugate() * (x - at); }
};

/// Velocity of a rigid body: that of the point `at`, and its spin.
struct Twist {
  Vec3 v = Vec3::Zero();   ///< [m/s]
  Vec3 w = Vec3::Zero();   ///< [rad/s]
  Vec3 at = Vec3::Zero();  ///< [m]
  Vec3 velocity(const Vec3& x) const { return v + w.cross(x - at); }
};

}  // namespace sluice
