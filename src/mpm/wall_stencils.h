#pragma once
/// Which patches each 3 x 3 x 3 stencil of nodes can meet, and the table that finds a stencil's record.
///
///      near box  [base - 1, base + 3]   all that lies within 1.5 h of a point of the stencil
///       cut box  [base, base + 2]       all segments from a point of the stencil to one of its 27 nodes
///    point cell  [base + 1/2, base + 3/2]
///
/// Grid units throughout. The section of a patch with a box is known by its triangles; where it is convex,
/// by the few boundary edges that meet the box (a lip: one). Without such an edge the patch covers the
/// whole section of its plane with the box: there, the side of the plane decides alone.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "mpm/wall_field.h"
#include "mpm/wall_patches.h"

namespace sluice {

constexpr std::uint32_t all_nodes = (1u << 27) - 1;

/// The part of a patch in one of the boxes.
struct PatchSection {
  std::int32_t triangles = 0;  ///< how many of the patch's triangles meet the box
  std::int32_t edges = 0;      ///< first of its half planes, in WallStencils::edges
  /// Where the section is convex: how many half planes bound it (0 = the patch covers the whole section of
  /// its plane with the box). Otherwise -1: ask the triangles.
  std::int32_t edge_count = -1;
  bool covered() const { return edge_count == 0; }
};

/// One patch in one stencil.
struct StencilPatch {
  std::int32_t patch = -1;
  std::uint32_t above = 0;     ///< nodes on the normal's side
  std::int32_t triangles = 0;  ///< first of its triangles, in WallStencils::triangles
  std::int32_t cuts = 0;       ///< 1 if it can hide nodes of the stencil
  std::int32_t goes_on = 0;    ///< 1 if a smooth surface goes on beyond one of its triangles' edges
  PatchSection near{};         ///< in the near box
  PatchSection cut{};          ///< in the cut box; its triangles come first
};

struct StencilRecord {
  Vec3i base = Vec3i::Zero();
  std::int32_t patches = 0;  ///< first of its patches, in WallStencils::patches
  std::int32_t cutting = 0;  ///< how many can hide nodes; these come first
  std::int32_t near = 0;     ///< how many meet the near box
  std::int32_t bodies = 0;   ///< first of its bodies, in WallStencils::bodies
  std::int32_t body_count = 0;
};

class WallStencils {
 public:
  /// @param reach  bases from lo to hi are recorded, both included
  WallStencils(const WallPatches& walls, const Vec3i& lo, const Vec3i& hi);

  /// Index of the record of a base, or -1.
  int find(const Vec3i& base) const {
    const auto i = static_cast<std::uint32_t>(base[0] - lo_[0]);
    const auto j = static_cast<std::uint32_t>(base[1] - lo_[1]);
    const auto k = static_cast<std::uint32_t>(base[2] - lo_[2]);
    const std::uint32_t bi = i >> 2, bj = j >> 2, bk = k >> 2;
    if (bi >= blocks_[0] || bj >= blocks_[1] || bk >= blocks_[2]) return -1;
    const std::int32_t block = block_[(static_cast<std::size_t>(bi) * blocks_[1] + bj) * blocks_[2] + bk];
    if (block < 0) return -1;
    return cell_[static_cast<std::size_t>(block) + ((i & 3) << 4 | (j & 3) << 2 | (k & 3))];
  }
  std::span<const StencilPatch> patches_of(const StencilRecord& r) const {
    return {patches.data() + r.patches, static_cast<std::size_t>(r.near)};
  }
  std::span<const std::int32_t> triangles_of(const StencilPatch& p) const {
    return {triangles.data() + p.triangles, static_cast<std::size_t>(p.near.triangles)};
  }
  std::span<const std::int32_t> bodies_of(const StencilRecord& r) const {
    return {bodies.data() + r.bodies, static_cast<std::size_t>(r.body_count)};
  }
  std::span<const Vec3> edges_of(const PatchSection& section) const {
    return {edges.data() + section.edges, static_cast<std::size_t>(std::max(0, section.edge_count))};
  }
  std::size_t memory_bytes() const;

  std::vector<StencilRecord> records;
  std::vector<StencilPatch> patches;
  std::vector<std::int32_t> triangles;  ///< indices of WallPatches::triangles
  std::vector<Vec3> edges;              ///< half planes, as WallTriangle::edge
  std::vector<std::int32_t> bodies;     ///< indices of WallPatches::bodies

 private:
  int find_or_add(const Vec3i& base);
  void order_records(std::vector<std::int32_t>& record_of_pair, std::vector<std::int32_t>& record_of_body);
  void classify_all(const WallPatches& walls);
  void classify(const WallPatches& walls, StencilRecord& record, std::vector<Vec3>& found_edges);

  Vec3i lo_ = Vec3i::Zero();
  std::array<std::uint32_t, 3> blocks_{0, 0, 0};
  std::vector<std::int32_t> block_;  ///< first cell of each block of 4 x 4 x 4 bases, or -1
  std::vector<std::int32_t> cell_;   ///< record of each base in a block, or -1
};

}  // namespace sluice
