#pragma once
/// Walls that move, as rocks meet them.
///
/// Walls of one motion form a body that rests in a frame of its own: its triangles, patches and queries
/// never change. A rock is taken into that frame, its contacts are found and remembered there, so springs
/// and normals turn with the wall; for the contact law they are taken back to space.
///
/// The surface's velocity is its displacement over the step, between the same poses that the contacts are
/// found with, as a rock's half-step velocity is its own: overlap and spring then change by exactly what
/// the law is told, and a rock that rides on the wall neither gains nor loses by a mismatch. The motion's
/// work takes the contact forces before and after that displacement, half each, as the rocks' kicks do.

#include <vector>

#include "dem/wall_contact.h"
#include "dem/wall_surface.h"
#include "geometry/wall.h"

namespace sluice {

/// What of the walls is near a rock, and its contacts with them.
struct RockWalls {
  Vec3 at = Vec3::Constant(std::numeric_limits<double>::infinity());  ///< where the triangles were looked up
  std::vector<WallTouch> touches;
  WallParts parts;
};

/// How a wall moves where a rock touches it.
struct SurfaceMotion {
  Vec3 velocity = Vec3::Zero();  ///< of motion and belt [m/s]
  Vec3 belt = Vec3::Zero();      ///< the belt's part of it [m/s]
  Vec3 spin = Vec3::Zero();      ///< [rad/s]
};

/// What of a belt's velocity [m/s] a contact with normal n feels: a surface that moves along itself. Across
/// itself the wall stands still, as on the edges of a belt or on the sides of a tray whose floor runs.
inline Vec3 along_surface(const Vec3& velocity, const Vec3& n) {
  return velocity - velocity.dot(n) * n;
}

struct MovingWalls {
  WallMotion motion;
  Walls walls;  ///< at rest; numbered as in the scene, those of other motions without triangles
  WallSurface surface;
  Pose before, now;                  ///< at the ends of the step
  Twist twist;                       ///< of the step
  std::vector<RockWalls> near = {};  ///< one per rock, rest frame

  void place(double t);            ///< at rest for the time being
  void move(double t, double dt);  ///< from t to t + dt
  /// @param in_space  the contact, as to_space gives it
  SurfaceMotion surface_motion(const WallTouch& in_space, double dt) const;
  WallTouch to_space(const WallTouch& touch) const;
  /// History of a contact that the law has changed in space.
  void keep_history(const WallTouch& in_space, WallTouch& touch) const;
};

/// The walls without motion, numbered as in the scene, the others without triangles.
Walls still_walls(const Walls& walls);
/// The walls with motion, one entry for each motion.
std::vector<MovingWalls> moving_walls(const Walls& walls);

}  // namespace sluice
