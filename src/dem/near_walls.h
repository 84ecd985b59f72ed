#pragma once
/// Walls beside a rock that it does not touch.

#include "base/vec.h"

namespace sluice {

/// The surface of a wall at one place where its distance from a sphere has a minimum of its own.
struct NearWall {
  int wall = 0;
  Vec3 point = Vec3::Zero();     ///< on the wall [m]
  Vec3 normal = Vec3::Zero();    ///< from the rock to the wall, unit
  Vec3 velocity = Vec3::Zero();  ///< of the surface, belt and motion [m/s]
  double gap = 0;                ///< between the rock's sphere and the wall, below 0 where they touch [m]
};

}  // namespace sluice
