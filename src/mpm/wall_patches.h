#pragma once
/// Walls cut into flat patches: edge-connected coplanar triangles of one wall. All lengths in grid units,
/// (x - origin) / h.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/domain.h"
#include "geometry/wall.h"
#include "mpm/wall_poses.h"
#include "mpm/which_walls.h"

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

/// Stencils by blocks of 4 x 4 x 4 bases, some of which are marked.
class MarkedBases {
 public:
  /// Marks the blocks with a base whose near box meets one of these boxes.
  explicit MarkedBases(const std::vector<Box>& boxes);
  bool at(const Vec3i& base) const { return mark(block(base)); }
  /// True if a marked block has a base whose near box meets this one.
  bool meets(const Box& box) const;
  Vec3i lowest() const { return 4 * lo_; }
  Vec3i highest() const { return 4 * hi_ + Vec3i::Constant(3); }

 private:
  static Vec3i block(const Vec3i& base) { return {base[0] >> 2, base[1] >> 2, base[2] >> 2}; }
  static std::array<Vec3i, 2> blocks_near(const Box& box);
  bool mark(const Vec3i& block) const {
    return (block.array() >= lo_.array()).all() && (block.array() <= hi_.array()).all() &&
           marks_[slot(block)];
  }
  std::size_t slot(const Vec3i& block) const {
    const Vec3i d = block - lo_, n = hi_ - lo_ + Vec3i::Ones();
    return static_cast<std::size_t>(d[0]) +
           static_cast<std::size_t>(n[0]) * (static_cast<std::size_t>(d[1]) +
                                             static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(d[2]));
  }
  Vec3i lo_ = Vec3i::Zero(), hi_ = Vec3i::Constant(-1);
  std::vector<char> marks_;
};

struct WallPatches {
  std::optional<MarkedBases> only;      ///< the stencils that know of all walls; absent: all do
  std::vector<WallTriangle> triangles;  ///< sorted by patch
  std::vector<WallPatch> patches;
  std::vector<RoundBody> bodies;  ///< in grid units
  double tolerance = 1e-6;        ///< two places closer than this are one
};

/// Walls that block water where they are, near the domain; with the periodic images near its periodic faces.
WallPatches make_wall_patches(const Walls& walls, const WallPoses& poses, const Domain& domain,
                              const Vec3& origin, double h, WhichWalls which);

}  // namespace sluice
