#pragma once
/// The coupling grid: levels of nodes with spacing h, 2h, 4h, ... A rock uses the level on which the
/// kernel (trilinear, 2 spacings wide) is at least the stated multiple of its size, so that no rock
/// needs more than eight nodes. Periodic axes hold a whole number of cells.
///
/// Fluid nodes are averaged onto the finest level in use, that one on to the next coarser one in use, and so
/// on, each with trilinear weights. What a level's node gives back goes down the same way, in proportion
/// to mass: sums are exact in both directions. Only fluid that a rock's kernel reaches is averaged, and only
/// nodes that such fluid or a rock reaches are visited or cleared.
///
/// Whoever adds to nodes goes through each_slab: threads work on slabs that do not meet.

#include <array>
#include <cstdint>
#include <vector>

#include "base/domain.h"
#include "coupling/slab_order.h"
#include "fluid/fluid_system.h"

namespace sluice {

/// Eight nodes and weights (sum 1) of a place on a level.
struct LevelWeights {
  std::array<int, 8> node{};
  std::array<double, 8> weight{};
  int slab = 0;  ///< of the cell, counted over all levels
};

/// The same in short: the cell's lowest node, how many nodes on the next one stands along each axis, and how
/// far the place is towards it [0..1].
struct LevelPlace {
  int low = 0, slab = 0;
  std::array<int, 3> next{};
  std::array<double, 3> upper{};

  LevelWeights weights() const;
};

/// Eight sums of a node, one cache line.
using NodeLanes = double __attribute__((vector_size(64)));

/// Fluid and solids: sums of mass, momentum, mass x density, mass x viscosity; volume of rock, wherever water
/// is or not; 1 / volume of the node inside the domain.
namespace fluid_lane {
inline constexpr int mass = 0, momentum = 1, density = 4, viscosity = 5, solids = 6, per_volume = 7;
}
/// Of wet rocks: sum of b w [kg], of b w v_rock [kg m/s] (the common velocity u' once nodes are solved, u' -
/// u in scatter); impulse to be given to the fluid [N s] and wetted volume of rock [m3], per mass of fluid in
/// scatter.
namespace rock_lane {
inline constexpr int take_up = 0, velocity = 1, impulse = 4, displaced = 7;
}

/// Sums at the nodes of one level; arrays of #nodes.
struct CouplingLevel {
  struct alignas(64) Sums {
    NodeLanes lanes{};
  };
  struct alignas(32) Acceleration {
    double __attribute__((vector_size(32))) lanes{};
  };
  Vec3 spacing = Vec3::Zero();  ///< [m]
  Vec3 per_spacing = Vec3::Zero();
  Vec3i nodes = Vec3i::Zero();             ///< per axis
  int first_slab = 0, slab_axis = 0;       ///< slabs of cells stand across the longest axis
  std::vector<Sums> fluid;                 ///< fluid_lane
  std::vector<Sums> rock;                  ///< rock_lane; zero where no fluid is
  std::vector<Acceleration> acceleration;  ///< Du/Dt, mass-weighted mean [m/s2]
  std::vector<double> packed;              ///< solids fraction, of all coarser levels too, where fluid is
  std::vector<int> wet;                    ///< nodes with fluid, slab by slab
  std::vector<LevelWeights> up;            ///< of each of its nodes on the next coarser level in use
  std::vector<int> down, down_begin;  ///< nodes of the next finer level in use that reach each of its nodes
  std::vector<std::uint8_t> asked;    ///< nodes whose fluid a rock asks for, itself or through coarser levels
  std::vector<int> all_asked;         ///< those nodes

  double cell_volume() const { return spacing.prod(); }
  NodeLanes& fluid_at(int node) { return fluid[static_cast<std::size_t>(node)].lanes; }
  const NodeLanes& fluid_at(int node) const { return fluid[static_cast<std::size_t>(node)].lanes; }
  NodeLanes& rock_at(int node) { return rock[static_cast<std::size_t>(node)].lanes; }
  const NodeLanes& rock_at(int node) const { return rock[static_cast<std::size_t>(node)].lanes; }
  /// Half the curl of the common velocity u' around a place [rad/s]. @param place  with weights by mass
  Vec3 water_spin(const LevelWeights& place) const;
};

/// What rocks do to the fluid's nodes; arrays of #nodes.
struct FromRocks {
  std::vector<Vec3> impulse;         ///< drag and buoyancy [N s]
  std::vector<Vec3> change_by_drag;  ///< of velocity, by drag alone [m/s]
  std::vector<double> displaced;     ///< wetted volume [m3]
};

class CouplingGrid {
 public:
  /// @param narrowest, widest  kernels that rocks of the scene ask for [m]; decide which levels are in use
  CouplingGrid(const Domain& domain, double fluid_spacing, double narrowest, double widest);

  /// Level whose kernel is at least `width` [m]. The widest level has two cells along the domain's
  /// longest side.
  int level_for(double width) const;
  CouplingLevel& level(int l) { return levels_[static_cast<std::size_t>(l)]; }
  const CouplingLevel& level(int l) const { return levels_[static_cast<std::size_t>(l)]; }
  int finest() const { return finest_; }      ///< level in use
  int coarsest() const { return coarsest_; }  ///< level in use
  LevelPlace place(int l, const Vec3& x) const;
  LevelWeights weights(int l, const Vec3& x) const { return place(l, x).weights(); }
  double kernel_width(int l) const { return 2 * level(l).spacing.minCoeff(); }  ///< [m]

  std::size_t slab_count() const { return wet_.size(); }
  /// Calls body(slab, items) for each slab of all levels, side by side where they do not meet.
  template <class Body>
  void each_slab(const SlabOrder& order, const Body& body) const {
    for (const std::vector<int>& colour : colours_)
      parallel_chunks(colour.size(), 1, [&](std::size_t c, std::size_t, std::size_t) {
        const auto s = static_cast<std::size_t>(colour[c]);
        if (!order.slab(s).empty()) body(s, order.slab(s));
      });
  }

  void clear_solids();
  /// Adds a rock's volume [m3] at a place of level l, whose fluid is then gathered. To be called within
  /// each_slab.
  void add_solids(int l, const LevelWeights& place, double volume);
  /// Averages the fluid's nodes on to every level in use, where a rock was added; what the levels held of the
  /// fluid is dropped.
  void gather(const FluidNodes& nodes);
  /// Solids fraction at each of these nodes, of all rocks, wet or dry. @pre gather was called with these
  /// nodes
  void solids_fraction(const FluidNodes& nodes, std::vector<double>& fraction);
  /// The same nodes' acceleration. @pre gather was called with these nodes
  void gather_acceleration(const FluidNodes& nodes, const std::vector<Vec3>& acceleration);
  /// What the rocks of all levels do to each fluid node. @pre as above, and nodes are solved
  void scatter(const FluidNodes& nodes, FromRocks& out);
  std::size_t memory_bytes() const;

 private:
  void make(int l);
  void clear_fluid();
  void list_wet(int l);
  void list_down(int l);
  void find_asked();
  void place_fluid(const FluidNodes& nodes);
  void colour_slabs();
  int slabs_of(int l) const;
  Vec3 place_of(int l, int node) const;

  Domain domain_;
  double fluid_spacing_;
  int finest_ = 0, coarsest_ = 0;  ///< levels in use
  std::vector<CouplingLevel> levels_;
  std::vector<std::vector<int>> colours_;      ///< slabs that do not meet
  std::vector<std::vector<int>> wet_, rocky_;  ///< nodes that a slab was the first to reach
  std::vector<LevelPlace> place_of_fluid_;     ///< on the finest level in use; slab -1: no rock asks
  SlabOrder of_fluid_;                         ///< fluid nodes on that level
  std::vector<SlabOrder> of_level_;            ///< wet nodes of a level on the next coarser one
};

}  // namespace sluice
