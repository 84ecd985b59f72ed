#pragma once
/// Where nodes and blocks lie in the domain, and how they are numbered.
///
/// A cell is the neighbourhood of one node, half a spacing to each side: a point's cell is its nearest
/// node. A block is 4 x 4 x 4 cells; along a periodic axis the last block may be narrower. A cell's key
/// is 64 * block + (i + 4 j + 16 k).

#include <cstdint>

#include "base/domain.h"

namespace sluice {

class BlockLayout {
 public:
  static constexpr int edge = 4;                    ///< cells along a block
  static constexpr int nodes = edge * edge * edge;  ///< of a block
  static constexpr int tile_edge = edge + 2;        ///< nodes that a block's points reach, along an axis
  static constexpr int tile_nodes = tile_edge * tile_edge * tile_edge;
  static constexpr std::int32_t none = -1;

  /// @throws InputError: periodic length not a multiple of h, domain not finite, too many cells
  BlockLayout(const Domain& domain, double h);

  double h() const { return h_; }
  const Vec3& origin() const { return origin_; }  ///< of node (0, 0, 0) [m]
  const Vec3i& cells() const { return cells_; }
  const Vec3i& blocks() const { return blocks_; }
  std::int32_t block_count() const { return blocks_.x() * blocks_.y() * blocks_.z(); }

  Vec3i block_place(std::int32_t block) const {
    return {block % blocks_.x(), (block / blocks_.x()) % blocks_.y(), block / (blocks_.x() * blocks_.y())};
  }
  /// Cells of a block along an axis, 1..4.
  int width(int axis, int place) const {
    const int left = cells_[axis] - edge * place;
    return left < edge ? left : edge;
  }
  Vec3i width(const Vec3i& place) const {
    return {width(0, place.x()), width(1, place.y()), width(2, place.z())};
  }
  /// Block at `place` + (dx, dy, dz), wrapped through periodic faces; `none` beyond the others.
  std::int32_t neighbour(const Vec3i& place, int dx, int dy, int dz) const;
  /// Key of a cell, wrapped through periodic faces; `none` where its stencil leaves the grid.
  std::int32_t key(Vec3i cell) const;
  Vec3i cell_of(std::int32_t key) const {
    const Vec3i place = block_place(key >> 6);
    return {edge * place.x() + (key & 3), edge * place.y() + ((key >> 2) & 3),
            edge * place.z() + ((key >> 4) & 3)};
  }
  Vec3 node_position(const Vec3i& node) const { return origin_ + h_ * node.cast<double>(); }

 private:
  double h_ = 0;
  Vec3 origin_ = Vec3::Zero();
  Vec3i cells_ = Vec3i::Zero();
  Vec3i blocks_ = Vec3i::Zero();
  std::array<bool, 3> periodic_{};
};

}  // namespace sluice
