#pragma once
/// Segments against flat patches, one at a time and 32 at a time. Grid units.
///
/// One rule for ties, everywhere: a place exactly on a plane counts as on the side of the plane's normal.
/// A segment crosses a patch when its ends lie on different sides and its point in the plane lies inside
/// one of the patch's triangles, grown by a tolerance so that no seam is left open.

#include <bit>
#include <optional>
#include <span>

#include "mpm/wall_patches.h"
#include "mpm/wall_stencils.h"

namespace sluice {

inline double height_over(const WallPatch& patch, const Vec3& x) {
  return patch.normal.dot(x) - patch.offset;
}
inline bool is_above(double height) {
  return height >= 0;
}

/// Of a body, told to a fluid that resolves a cell: a ball of half a cell.
constexpr double sharpest_curvature = 2;

/// Patches of a scene and where they stand to the grid.
struct Sight {
  const WallPatches& walls;
  const WallStencils& stencils;

  /// A body beside a place.
  BodyFace face(std::int32_t body, const Vec3& x) const {
    return walls.bodies[static_cast<std::size_t>(body)].face(x, sharpest_curvature);
  }
  /// Bodies count as patches behind the flat ones.
  int patch_of_body(std::int32_t body) const { return static_cast<int>(walls.patches.size()) + body; }
  int wall_of(int patch) const {
    const auto flat = static_cast<int>(walls.patches.size());
    return patch < flat ? walls.patches[static_cast<std::size_t>(patch)].wall
                        : walls.bodies[static_cast<std::size_t>(patch - flat)].wall;
  }
  const WallPatch& plane(const StencilPatch& p) const {
    return walls.patches[static_cast<std::size_t>(p.patch)];
  }
  /// True if a point of the plane and of the near box lies in the patch, within `tolerance`.
  bool inside(const StencilPatch& p, const Vec3& q, double tolerance) const;
  /// Where along a-b the patch is crossed, 0..1. @pre a and b lie in the near box
  std::optional<double> crossing(const StencilPatch& p, const Vec3& a, const Vec3& b) const;
  /// True if no patch of the record but `except` (an index of a patch or of a body as one, -1 for none)
  /// stands between a and b.
  bool sees(const StencilRecord& record, const Vec3& a, const Vec3& b, int except) const;
};

/// Far ends of 32 segments.
struct Targets {
  static constexpr int count = 32;
  alignas(64) double x[3][count];
};

enum class Reach { cut_box, near_box };

/// Bits of the targets that a patch hides from x; `s` receives where each segment meets the plane (only
/// valid for those beyond the plane).
/// @param reach  the box that holds x and the targets
/// @param candidates  bits of the targets beyond the plane
std::uint32_t hidden_targets(const Sight& sight, const StencilPatch& p, Reach reach, const Vec3& x,
                             const Targets& targets, std::uint32_t candidates, double* s);

/// Bits of the targets that a body hides from x.
std::uint32_t hidden_by(const BodyFace& face, const Vec3& x, const Targets& targets);

/// Bits of the targets on the side of the plane on which x is not.
std::uint32_t targets_beyond(const WallPatch& plane, const Vec3& x, const Targets& targets);

}  // namespace sluice
