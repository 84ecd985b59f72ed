#pragma once
/// The material points: hot records sorted by block and cell, cold columns beside them.
///
/// Points move every step but are re-sorted only when enough of them left their block. Until then each
/// point is either a resident of the block whose bin it lies in, or a stray, listed under the block it
/// is in now. New points wait unsorted at the end and are strays; removed ones keep their place with the
/// key `none` until the next sort. All orders are functions of what is stored, never of the threads.

#include <cmath>
#include <span>
#include <vector>

#include "base/state_archive.h"
#include "mpm/block_layout.h"
#include "mpm/brief_vector.h"
#include "mpm/quads.h"

namespace sluice {

/// What a step reads and writes of one point. The fourth numbers of the quads hold what else belongs to it.
template <class Real>
struct MaterialPoint {
  Quad<Real> x{};     ///< from the nearest node [cells], -0.5..0.5, multiples of the position quantum; J - 1
  Quad<Real> v{};     ///< [m/s]; mass [kg]
  Quad<Real> C[3]{};  ///< affine velocity by columns: C[c][r] = d v_r / d x_c [1/s]; volume, viscosity, void

  /// J - 1: keeps its digits where J is nearly 1.
  Real dilation() const { return x[3]; }
  Real mass() const { return v[3]; }          ///< [kg]
  Real volume() const { return C[0][3]; }     ///< at rest [m3]
  Real viscosity() const { return C[1][3]; }  ///< at the point's rate of shear [Pa s]
  /// Of the mixture around it, 1 without rocks.
  Real void_fraction() const { return C[2][3]; }
};

/// sqrt(2 D:D), D = (C + C^T) / 2 without the part that changes volume [1/s].
template <class Real>
Real rate_of_shear(const MaterialPoint<Real>& p) {
  const Real third = (p.C[0][0] + p.C[1][1] + p.C[2][2]) / 3;
  Real squares = 0;
  for (int r = 0; r < 3; ++r) {
    const Real along = p.C[r][r] - third;
    squares += along * along;
    for (int c = 0; c < r; ++c) {
      const Real across = Real(0.5) * (p.C[c][r] + p.C[r][c]);
      squares += 2 * across * across;
    }
  }
  return std::sqrt(2 * squares);
}

/// Rounds a position to the quantum, a multiple of 2^-22 cells in float: changing cells is then exact.
/// @pre |x| < 1 [cells]: 3 + x lies in [2, 4), whose floats are that far apart
template <class Real>
Real quantised(Real x) {
  return (x + Real(3)) - Real(3);
}
template <class Real>
Quad<Real> quantised(Quad<Real> x) {
  return (x + Real(3)) - Real(3);
}

template <class Real>
struct StateTraits<MaterialPoint<Real>> {
  static constexpr Scalar scalar = StateTraits<Real>::scalar;
  static constexpr std::size_t count = 20;
};

/// A block with points: residents [begin, end) of the store, then strays [stray_begin, stray_end) of the
/// list of strays. `reach` has bit (dx+1) + 3 (dy+1) + 9 (dz+1) set when a stencil reaches that neighbour.
struct PointBlock {
  std::int32_t block = BlockLayout::none;
  std::uint32_t begin = 0, end = 0;
  std::uint32_t stray_begin = 0, stray_end = 0;
  std::uint32_t reach = 0;
  std::uint32_t count() const { return end - begin + stray_end - stray_begin; }
};

template <class Real>
class PointStore {
 public:
  using Point = MaterialPoint<Real>;
  using Place = std::array<Real, 3>;

  explicit PointStore(const BlockLayout& layout);

  std::size_t count() const { return points.size() - dead_; }
  std::size_t slots() const { return points.size(); }  ///< live and dead
  bool alive(std::size_t slot) const { return key[slot] != BlockLayout::none; }

  void add(const Point& point, std::int32_t cell_key, std::uint64_t point_id, double point_mass,
           double fines);
  void remove(std::size_t slot);

  /// Finds the blocks that have points, and those of each cell; sorts first when too many are strays.
  void bin();
  const std::vector<PointBlock>& blocks() const { return blocks_; }
  /// Index into blocks() or `none`.
  std::int32_t index_of_block(std::int32_t block) const {
    return index_of_block_[static_cast<std::size_t>(block)];
  }

  /// Slots of the points of a block, by index in blocks(), that lie in one of its cells; in the fixed order.
  std::span<const std::uint32_t> of_cell(std::size_t block, int local) const {
    const auto& begin = cell_begin_[block];
    const auto c = static_cast<std::size_t>(local);
    return {order_.data() + begin[c], begin[c + 1] - begin[c]};
  }
  /// All of them, cell by cell.
  std::span<const std::uint32_t> of_block(std::size_t block) const {
    const auto& begin = cell_begin_[block];
    return {order_.data() + begin.front(), begin.back() - begin.front()};
  }

  std::size_t memory_bytes() const;
  void exchange(StateArchive& archive);

  std::vector<Point> points;
  std::vector<Place> before;  ///< at the start of the last step, from the nearest node of now [cells]
  std::vector<BriefVector<Real>> misfit;  ///< to its velocity from the grid's, a step ago [m/s]
  std::vector<std::int32_t> key;          ///< cell, `none` for a removed point
  std::vector<std::uint64_t> id;
  std::vector<double> mass;   ///< as it came in [kg]
  std::vector<double> fines;  ///< as it came in [kg]; empty while all are 0

 private:
  void find_strays();
  void list_strays();
  void order_by_cell();
  void sort();
  template <class T>
  void reorder(std::vector<T>& column);
  void reorder_points();
  /// Calls body(slot) for each point of a block, in the fixed order.
  template <class Body>
  void for_each(const PointBlock& block, const Body& body) const {
    const std::uint32_t residents = block.end - block.begin;
    const std::uint32_t all = residents + block.stray_end - block.stray_begin;
    for (std::uint32_t n = 0; n < all; ++n) {
      const std::uint32_t slot = n < residents ? block.begin + n : strays_[block.stray_begin + n - residents];
      if (n < residents && key[slot] >> 6 != block.block) continue;
      body(slot);
    }
  }

  const BlockLayout* layout_;
  std::vector<std::int32_t> bin_block_;   ///< sorted: block of each bin
  std::vector<std::uint32_t> bin_begin_;  ///< #bins + 1; what lies beyond the last is unsorted
  std::size_t dead_ = 0;

  // Scratch of a step.
  std::vector<PointBlock> blocks_;
  std::vector<std::int32_t> index_of_block_;
  std::vector<std::uint32_t> strays_;
  std::vector<std::vector<std::uint32_t>> strays_of_bin_;
  std::vector<std::uint32_t> reach_of_bin_;
  std::vector<std::uint32_t> stray_place_;
  std::vector<std::uint32_t> order_;                                           ///< slots by block and cell
  std::vector<std::array<std::uint32_t, BlockLayout::nodes + 1>> cell_begin_;  ///< in order_, per block
  std::array<std::uint32_t, 64> reach_of_cell_{};                              ///< for blocks of full width
};

}  // namespace sluice
