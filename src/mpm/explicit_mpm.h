#pragma once
/// Explicit material point method for weakly compressible water, in float (production) or double.
///
///   points_to_grid   bin points; each block of points scatters into a tile of its own (6 x 6 x 6 nodes of
///                    16 lanes); node blocks add up the tiles that reach them, in a fixed order: no atomics,
///                    the same bits for any number of threads
///   walls            nodes beside walls: pressure closure, no flow through, friction; coupling impulses
///   grid_to_points   each block copies its 6 x 6 x 6 nodes and moves its points
///
/// Scheme: quadratic B-splines and APIC (Jiang et al. 2015) with MLS stress (Hu et al. 2018); the velocity
/// keeps a part of its own past, with a time constant instead of a share per step; pressure is made quiet
/// by averaging the departure of J from the local pressure gradient, anchored to the density on the grid.
///
/// Spray. `bulk` b_i of a node ramps from 0 to 1 as its cell fills. A point takes
///     v += sum w dv_i + a sum w b_i (v_i - v - C d)
/// which moves no net momentum for any b_i, because v_i is the momentum mean of just these (v + C d). In
/// nearly empty cells b = 0: the point keeps its velocity, feels gravity and drag, has no pressure, and
/// shares its momentum with the water that it meets when the cells are full there.

#include <memory>

#include "mpm/mpm_system.h"
#include "mpm/node_blocks.h"
#include "mpm/wall_field.h"
#include "mpm/wall_impulses.h"

namespace sluice {

FluidStepLimits step_limits(const MpmConfig& config, const Vec3& gravity, double largest_kinematic_viscosity);

template <class Real>
class ExplicitMpm final : public FluidSystem {
 public:
  ExplicitMpm(const MpmConfig& config, const Domain& domain, const Vec3& gravity, const Walls& walls);

  double spacing() const override { return config_.spacing; }
  const FluidStepLimits& limits() const override { return limits_; }
  const FluidModel& model() const override { return config_.fluid; }
  double point_volume() const override;
  std::uint64_t add(const NewPoint& point) override;
  std::size_t count() const override { return store_.count(); }
  WaterPoints points() const override;
  std::vector<RemovedPoint> remove_if(
      const std::function<bool(const Vec3& before, const Vec3& now)>& leaves) override;
  std::vector<RemovedPoint> remove_outside() override;
  void points_to_grid(double t, double dt) override;
  void walls(double dt) override;
  void grid_to_points(double dt) override;
  void read_accelerations(std::vector<Vec3>& acceleration) const override;
  void read_nodes(FluidNodes& nodes) const override;
  void add_impulse(std::span<const Vec3> impulse) override;
  void set_void_fraction(std::span<const double> void_fraction) override;
  const std::vector<WallLoad>& wall_loads() const override { return loads_; }
  Vec3 momentum() const override;
  Vec3 impulse_from_gravity() const override { return gravity_impulse_; }
  Vec3 momentum_added() const override { return momentum_added_; }
  Vec3 momentum_removed() const override { return momentum_removed_; }
  double kinetic_energy() const override;
  double kinetic_added() const override { return kinetic_added_; }
  double kinetic_removed() const override { return kinetic_removed_; }
  double largest_speed() const override { return largest_speed_; }
  double total_mass() const override;
  double total_fines() const override;
  std::uint64_t state_hash() const override;
  std::size_t memory_bytes() const override;
  void exchange(StateArchive& archive) override;

 private:
  using Point = MaterialPoint<Real>;
  using Node = Lanes<Real>;

  /// What all points share in a step.
  struct StepNumbers {
    double t = 0, dt = 0;
    Real relax_velocity = 0;  ///< a: share of the grid's velocity taken in a step
    Real relax_dilation = 0;
    Real anchor = 0;  ///< dt / t_R
    Real shift = 0;   ///< per fill gradient [cells]
  };
  /// Nodes around a block, with what only the place knows.
  struct NodeTile {
    Node node[BlockLayout::tile_nodes];
    Real void_fraction[BlockLayout::tile_nodes];
    Real least_fill[BlockLayout::nodes];  ///< over the 27 nodes of each cell
  };
  /// What one block's grid_to_points found.
  struct BlockReport {
    double mass = 0;                   ///< [kg]
    Real speed2 = 0, bulk_speed2 = 0;  ///< largest squares [m2/s2]
    std::uint32_t fastest_bulk = 0;
    bool left_grid = false;
    bool stopped = false;  ///< a point's velocity is not finite or carries it too far
    bool finite = true;
    Real move = 0;  ///< of the culprit, along an axis [cells]
    std::uint32_t culprit = 0;
  };
  /// What a point gathers from its 27 nodes: weighted sums, and sums of w d with d in cells.
  struct Gathered {
    Real change[3];    ///< of v [m/s]
    Real velocity[3];  ///< b v_old [m/s]
    Real pressure[3];  ///< change of v by pressure alone [m/s]
    Real centre[3];    ///< mean x_p - x_i there [cells]
    Real bulk, fill, dilation, least_fill;
    Real moment[9];  ///< of change + velocity, row-major like C [m/s]
    Real bulk_moment[3];
    Real kept[6];  ///< of C: I - 4 sum b w d d^T, as xx yy zz yz xz xy
    Real fill_moment[3];
  };

  std::vector<RemovedPoint> remove_slots(std::vector<std::uint32_t>& slots);
  void prepare_block(std::int32_t slot);
  void scatter_block(std::size_t index);
  void contribution(const Point& p, Node (&a)[4]) const;
  void scatter_near_wall(const Point& p, std::int32_t cell_key, std::int32_t stencil, Node (&a)[4],
                         Node* tile, WallImpulses& impulses) const;
  void add_up_tiles(std::int32_t slot);
  std::uint32_t finish_nodes(std::int32_t slot);
  void wall_block(std::int32_t slot, std::uint32_t first, WallImpulses& impulses);
  void close_pressure(Node& node, double volume, std::span<const WallPlane> planes, const Vec3& at,
                      WallImpulses& impulses) const;
  void hold_at_walls(Node& node, double volume, Vec3 cut_off, std::span<const WallPlane> planes,
                     const Vec3& at, WallImpulses& impulses) const;
  void load_tile(const PointBlock& block, NodeTile& tile) const;
  void move_block(std::size_t index, NodeTile& tile);
  void gather_near_wall(const Point& p, std::int32_t cell_key, std::int32_t stencil, const NodeTile& tile,
                        Gathered& g, WallImpulses& impulses) const;
  void gather(const Point& p, int local, const NodeTile& tile, Gathered& g) const;
  void gather_kept(const Point& p, int local, const NodeTile& tile, Gathered& g) const;
  Real gather_void_fraction(const Point& p, int local, const NodeTile& tile) const;
  void update(Point& p, const Gathered& g, Real (&moved)[3]) const;
  void stop_at_walls(Point& p, std::int32_t cell_key, std::int32_t stencil, WallImpulses& impulses) const;
  void settle_in_cell(Point& p, std::int32_t& cell_key) const;
  int hiding_wall(const Visibility& seen, int node) const {
    return field_->patch_wall(seen.patch[static_cast<std::size_t>(node)]);
  }
  void check_reports();
  void pour_loads(std::size_t lists);

  Vec3 velocity_of(const Point& p) const { return Vec3(p.v[0], p.v[1], p.v[2]); }
  /// Of fluid at a node [Pa s]; fines are what makes it denser.
  /// @param density  without pressure [kg/m3]
  double viscosity_of(double density) const {
    const FluidModel& fluid = config_.fluid;
    return store_.fines.empty() ? fluid.viscosity : slurry_viscosity(fluid, fines_fraction(fluid, density));
  }
  double fines_of(std::size_t slot) const { return store_.fines.empty() ? 0.0 : store_.fines[slot]; }
  Vec3 position(const Real* x, std::int32_t cell_key) const {
    return layout_.origin() +
           config_.spacing * (layout_.cell_of(cell_key).template cast<double>() + Vec3(x[0], x[1], x[2]));
  }

  MpmConfig config_;
  Domain domain_;
  Vec3 gravity_;
  FluidStepLimits limits_;
  double sound_speed_ = 0;
  BlockLayout layout_;
  PointStore<Real> store_;
  NodeBlocks<Real> grid_;
  std::unique_ptr<WallField> field_;  ///< absent without walls

  StepNumbers step_;
  std::vector<Node> tiles_;  ///< tile_nodes per point block
  std::vector<std::uint32_t> node_begin_{
      0};                               ///< index of the first node with mass per active block, and the end
  std::vector<Vec3> impulse_;           ///< from the coupling, in the order of read_nodes; empty = none
  std::vector<WallImpulses> impulses_;  ///< per block
  std::vector<BlockReport> reports_;
  bool has_void_ = false;

  std::uint64_t next_id_ = 0;
  double largest_kinematic_viscosity_ = 0;
  double largest_speed_ = 0;
  Vec3 gravity_impulse_ = Vec3::Zero();
  Vec3 momentum_added_ = Vec3::Zero(), momentum_removed_ = Vec3::Zero();
  double kinetic_added_ = 0, kinetic_removed_ = 0;
  std::vector<WallLoad> loads_;
};

}  // namespace sluice
