#pragma once
/// The sparse grid: node data of the blocks that points reach in this step.
///
/// Blocks keep their slot while they stay active, so that what is held per node (void fraction) and what
/// belongs to the place (the record of the walls there) stays with them.

#include <array>
#include <functional>
#include <vector>

#include "mpm/block_layout.h"
#include "mpm/lanes.h"
#include "mpm/point_store.h"

namespace sluice {

/// Lanes of a node. After the scatter: sums. After points_to_grid: what is named first; after walls: second.
namespace node_lane {
constexpr int velocity = 0;    ///< momentum -> v before forces [m/s] -> the same times `bulk`
constexpr int mass = 3;        ///< [kg] -> bulk: 1 in bulk water, 0 in spray
constexpr int change = 4;      ///< impulse of stresses -> change of v by stresses and gravity -> by all [m/s]
constexpr int fill = 7;        ///< volume [m3] -> over the open space
constexpr int centre = 8;      ///< sum m (x_p - x_i) -> mean of it [cells]
constexpr int dilation = 11;   ///< sum m (J - 1) -> mean
constexpr int gradient = 12;   ///< sum V 4/h2 w d [m2] -> change of v by pressure alone [m/s]
constexpr int near_wall = 15;  ///< mass of points beside walls -> its share -> pull e b on its points, 0 to 1
}  // namespace node_lane

template <class Real>
class NodeBlocks {
 public:
  explicit NodeBlocks(const BlockLayout& layout);

  /// Makes the blocks that the points reach active, and no others.
  /// @param prepare  called for each block that was not active before: fill its stencils
  void activate(const std::vector<PointBlock>& blocks, const std::function<void(std::int32_t slot)>& prepare);

  /// Makes exactly these blocks (ascending) active, as after loading a saved state.
  void restore(const std::vector<std::int32_t>& blocks,
               const std::function<void(std::int32_t slot)>& prepare);

  const std::vector<std::int32_t>& active() const { return active_; }  ///< blocks, ascending
  std::int32_t slot_of(std::int32_t block) const { return slot_[static_cast<std::size_t>(block)]; }
  std::int32_t block_of(std::int32_t slot) const { return block_[static_cast<std::size_t>(slot)]; }

  Lanes<Real>* nodes(std::int32_t slot) {
    return &data_[static_cast<std::size_t>(slot) * BlockLayout::nodes];
  }
  const Lanes<Real>* nodes(std::int32_t slot) const {
    return &data_[static_cast<std::size_t>(slot) * BlockLayout::nodes];
  }
  /// What nodes tell points of their velocities, besides: sum m misfit and sum m rate of shear -> their means
  /// -> e b (s v - (1 - s) misfit) and e b s, with the share s of the pull that goes by the grid's velocity.
  Quad<Real>* blend(std::int32_t slot) {
    return &blend_[static_cast<std::size_t>(slot) * BlockLayout::nodes];
  }
  const Quad<Real>* blend(std::int32_t slot) const {
    return &blend_[static_cast<std::size_t>(slot) * BlockLayout::nodes];
  }
  /// Per node: 1 until fractions are held.
  const Real* void_fraction(std::int32_t slot) const {
    return void_.empty() ? no_rocks.data() : &void_[static_cast<std::size_t>(slot) * BlockLayout::nodes];
  }
  /// @pre hold_void_fractions() was called
  Real* held_void_fraction(std::int32_t slot) {
    return &void_[static_cast<std::size_t>(slot) * BlockLayout::nodes];
  }
  /// From now on nodes keep a void fraction, 1 at first.
  void hold_void_fractions();
  void forget_void_fractions() { void_.clear(); }
  /// Record of walls (WallField::stencil) per cell of a block.
  std::int32_t* stencil(std::int32_t slot) {
    return &stencil_[static_cast<std::size_t>(slot) * BlockLayout::nodes];
  }
  const std::int32_t* stencil(std::int32_t slot) const {
    return &stencil_[static_cast<std::size_t>(slot) * BlockLayout::nodes];
  }

  /// Sum m D of the points beside walls, D = (C + C^T) / 2, as xx yy zz yz xz xy, and after these the mass of
  /// points beyond a wall's free edge, per node; null in blocks that hold none.
  typename Lanes<Real>::Half* strain(std::int32_t slot) {
    const std::int32_t n = strain_slot_[static_cast<std::size_t>(slot)];
    return n < 0 ? nullptr : &strain_[static_cast<std::size_t>(n) * BlockLayout::nodes];
  }
  /// The slot shall hold it from the next hold_strains() on, for whatever block.
  void want_strain(std::int32_t slot) {
    std::int32_t& n = strain_slot_[static_cast<std::size_t>(slot)];
    if (n < 0) n = wanted_strain;
  }
  void hold_strains();

  std::size_t memory_bytes() const;

 private:
  static constexpr std::int32_t wanted_strain = -2;
  static constexpr std::array<Real, BlockLayout::nodes> no_rocks = [] {
    std::array<Real, BlockLayout::nodes> ones{};
    ones.fill(1);
    return ones;
  }();
  void make_room(std::size_t slots);
  void replace_active(const std::function<void(std::int32_t slot)>& prepare);

  const BlockLayout* layout_;
  std::vector<std::int32_t> slot_;   ///< per block of the domain
  std::vector<std::int32_t> block_;  ///< per slot
  std::vector<std::int32_t> free_;
  std::vector<std::int32_t> active_, wanted_;
  std::vector<std::uint32_t> mark_;  ///< per block: step at which it was last wanted
  std::uint32_t step_ = 0;
  std::vector<Lanes<Real>> data_;
  std::vector<Quad<Real>> blend_;
  std::vector<Real> void_;  ///< empty while nobody set any
  std::vector<std::int32_t> stencil_;
  std::vector<std::int32_t> strain_slot_;  ///< per slot; none without
  std::vector<typename Lanes<Real>::Half> strain_;
};

}  // namespace sluice
