#pragma once
/// Walls as a fluid on a regular grid sees them: which nodes a point can see, which planes are active at
/// a node, how much of a node's cell is open, and where a path first meets a wall.
///
/// A point and a node see each other when the segment between them crosses no triangle. Coplanar
/// neighbouring triangles are merged into patches. Per near-wall cell, a list of the patches within
/// reach of its stencil:
///
///   full patch     covers the whole stencil region: visibility is the side of its plane (one dot
///                  product and a precomputed bit mask of node sides)
///   partial patch  ends inside the region (lip, corner, T-joint): nodes on the far side are tested
///                  with the segment against the patch's triangles
///
/// Cells without a record take the plain kernel.
///
/// Ties. A point exactly on a plane is on the side of the patch's normal. Nodes are seen at
/// (i, j, k) + node_offset, so that none lies exactly on a wall that follows the grid: such a node belongs
/// to the wall's upper side and is hidden from the lower one; never does it mix the two. Points should be
/// kept off the walls by more than the noise of the CAD (1e-4 h by the path check).
///
/// Periodic axes. Positions and nodes are not wrapped here: a point lies in [lo, hi), its stencil and its
/// path may reach a few cells beyond a periodic face, and find there the images of the walls. A path that
/// began inside is tested with its unwrapped end.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "base/domain.h"
#include "geometry/wall.h"
#include "mpm/wall_poses.h"
#include "mpm/which_walls.h"

namespace sluice {

/// Where nodes count as being, from where they are [h]. Three unlike numbers, so that no simple plane holds
/// the offset; more than the noise of single-precision CAD, far below what the transfer resolves.
inline const Vec3 node_offset{1.00e-3, 0.83e-3, 0.61e-3};

/// A plane that acts on a node or a point. `normal` points towards the wall (out of the fluid).
struct WallPlane {
  Vec3 normal = Vec3::Zero();
  double distance = 0;  ///< from the node or point to the plane, >= 0 [m]
  int wall = -1;        ///< index of Walls::all()
  int patch = -1;
  double curvature = 0;  ///< mean, of a body; 0 of a flat wall [1/cells]
};

/// Which of the 27 nodes around a point are hidden from it. Bit i + 3 j + 9 k for the node base + (i, j, k).
struct Visibility {
  std::uint32_t hidden = 0;
  std::array<std::int32_t, 27> patch{};  ///< patch that hides the node first; valid where hidden
};

struct WallHit {
  double s = 0;  ///< along the path, 0..1
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< unit, on the side from which the path came
  int wall = -1;
  int patch = -1;
};

class WallField {
 public:
  /// Nodes lie at origin + h (i, j, k). Walls that block water only, or both, where `poses` has them.
  /// @param poses  must outlive this
  /// @param nodes  lowest and highest that anything will be asked about
  WallField(const Walls& walls, const WallPoses& poses, const Domain& domain, const Vec3& origin, double h,
            WhichWalls which, const std::array<Vec3i, 2>& nodes = all_nodes_of_domain);
  /// The same where they rest.
  WallField(const Walls& walls, const Domain& domain, const Vec3& origin, double h);
  ~WallField();

  /// Record of the stencil whose lowest node is `base` (floor((x - origin) / h - 1/2) for a point x), or -1
  /// where no wall is within reach: none within 1.5 h of any point of that cell.
  int stencil(const Vec3i& base) const;
  /// Hidden nodes for a point x [m] whose stencil starts at `base`.
  void visibility(int stencil, const Vec3i& base, const Vec3& x, Visibility& out) const;
  /// Planes within 1.5 h of the point whose foot is visible from it and lies inside the patch, or where a
  /// smooth surface (bending by less than 41 degrees) goes on beyond its edge: free lips do not count.
  /// Nearest first; facets whose normals' dot product with a nearer one exceeds 0.75 are merged into that
  /// one. At most `max` are written; returns how many.
  int planes_of_point(int stencil, const Vec3& x, WallPlane* out, int max) const;

  /// True for a point that comes within 1.5 h of the plane of a wall, but beyond its free edge: the wall ends
  /// before it.
  /// @pre planes_of_point found none
  bool beyond_edge(int stencil, const Vec3& x) const;

  /// Active planes of a node: as planes_of_point. Empty for nodes without walls near.
  std::span<const WallPlane> planes_of_node(const Vec3i& node) const;
  /// The same, for the node base + 1 of a stencil.
  std::span<const WallPlane> planes_at(int stencil) const;
  /// Bodies of WallPoses, -1 for the walls that stand, that come near a stencil. At most `max` are written;
  /// returns how many.
  int bodies_near(int stencil, int* out, int max) const;
  /// Fraction of the node's quadratic B-spline support (weighted) that is on the node's side of the walls
  /// near it, 1 far from walls; never below 0.02. Weighted by the spline, so that full water reads fill = 1.
  /// Not to be asked about one node by two threads at a time.
  double open_fraction(const Vec3i& node) const;
  /// The same, for the node base + 1 of a stencil.
  double open_fraction_at(int stencil) const;

  /// First wall met on the way from a to b (double precision, watertight over shared edges). `stencil` is
  /// that of a, or -1; paths that leave its surroundings are followed through the cells they cross. Walls
  /// more than 3 cells outside the domain are not met.
  /// @param body  of WallPoses that counts, -1 for the walls that stand; `any_body`: all
  /// @pre a and b are finite
  std::optional<WallHit> first_hit(int stencil, const Vec3& a, const Vec3& b, int body = any_body) const;
  static constexpr int any_body = -2;
  static inline const std::array<Vec3i, 2> all_nodes_of_domain{Vec3i::Constant(-(1 << 28)),
                                                               Vec3i::Constant(1 << 28)};

  const Vec3& patch_normal(int patch) const;
  int patch_wall(int patch) const;
  int patch_count() const;
  std::size_t memory_bytes() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sluice
