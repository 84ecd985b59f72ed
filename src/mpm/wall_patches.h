#pragma once
/// Walls cut into flat patches: edge-connected coplanar triangles of one wall. All lengths in grid units,
/// (x - origin) / h.

#include <array>
#include <cstdint>
#include <vector>

#include "base/domain.h"
#include "geometry/wall.h"
#include "mpm/wall_poses.h"

namespace sluice {

/// Normals of facets that bend less than this count as one smooth surface (cosine; walls-note's 0.75).
constexpr double smooth_cosine = 0.75;

struct WallTriangle {
  std::array<Vec3, 3> corner;  ///< in grid units
  /// Edge i runs from corner i to corner i + 1. For a point of the patch's plane with the two kept
  /// coordinates (u, v): edge[i] . (u, v, 1) is its distance to the edge, positive inside.
  std::array<Vec3, 3> edge;
  int patch = -1;
  std::uint8_t boundary = 7;  ///< bit i: no triangle of the patch lies beyond edge i
  std::uint8_t smooth = 0;    ///< bit i: a facet of another patch goes on beyond edge i, nearly straight on
};

struct WallPatch {
  Vec3 normal = Vec3::Zero();  ///< unit
  double offset = 0;           ///< plane: normal . x = offset
  double deviation = 0;        ///< largest distance of a corner from the plane
  int wall = -1;
  int u = 0, v = 1;  ///< the two coordinates kept when points of the plane are projected
};

struct WallPatches {
  std::vector<WallTriangle> triangles;  ///< sorted by patch
  std::vector<WallPatch> patches;
  double tolerance = 1e-6;  ///< two places closer than this are one
};

/// Walls that block water where they are, near the domain; with the periodic images near its periodic faces.
WallPatches make_wall_patches(const Walls& walls, const WallPoses& poses, const Domain& domain,
                              const Vec3& origin, double h);

}  // namespace sluice
