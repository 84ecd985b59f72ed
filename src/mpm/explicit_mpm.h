#pragma once
/// Explicit material point method for weakly compressible water, in float (production) or double.
///
///   points_to_grid   bin points; a block of points scatters into a tile (6 x 6 x 6 nodes of 16 lanes) and
///   adds
///                    it to the grid. Blocks of one colour share no node, and colours take turns in a fixed
///                    order: no atomics, the same bits for any number of threads
///   walls            nodes beside walls: pressure closure, no flow through, friction; coupling impulses
///   grid_to_points   each block copies its 6 x 6 x 6 nodes and moves its points
///
/// Scheme: quadratic B-splines and APIC (Jiang et al. 2015) with MLS stress (Hu et al. 2018); points keep
/// their velocity and forget what the grid does not know of it, in a time instead of by a share per step;
/// pressure is made quiet by averaging the departure of J from the local pressure gradient, anchored to the
/// density on the grid.
///
/// Velocities. `bulk` b_i of a node ramps from 0 to 1 as its cell fills. A point takes
///     v += sum w dv_i + a sum w e_i b_i (s_i (v_i - v - C d) + (1 - s_i) (r - r_i))
/// with its misfit r, which is what sum w b_i (v_i - v - C d) was a step ago: noise that no node sees, and
/// flow that bends within a few cells. Their mean r_i at a node knows the flow alone; the rest is forgotten.
/// That is the second order of XPIC (Hammerquist & Nairn 2017, CMAME 318:724), a step late instead of by a
/// second transfer: a wave of which the transfers keep the share T loses as (1 - T)^2, not as 1 - T. The
/// latter is left, s_i = 1, where water is sheared so fast that noise would outgrow it. The pull e_i of full
/// nodes is less than 1 where they accelerate. No e_i, b_i and s_i move net momentum, because v_i is the
/// momentum mean of just these (v + C d), and r_i that of r.
///
/// Spray. In nearly empty cells b = 0: the point keeps its velocity, feels gravity and drag, has no pressure,
/// and shares its momentum with the water that it meets when the cells are full there.

#include <memory>

#include "mpm/mpm_system.h"
#include "mpm/node_blocks.h"
#include "mpm/wall_field.h"
#include "mpm/wall_impulses.h"
#include "mpm/wall_poses.h"

namespace sluice {

/// @param fastest_wall  that moves [m/s]
FluidStepLimits step_limits(const MpmConfig& config, const Vec3& gravity, double largest_kinematic_viscosity,
                            double fastest_wall);

template <class Real>
class ExplicitMpm final : public FluidSystem {
 public:
  ExplicitMpm(const MpmConfig& config, const Domain& domain, const Vec3& gravity, const Walls& walls);

  double spacing() const override { return config_.spacing; }
  const FluidStepLimits& limits() const override { return limits_; }
  const FluidModel& model() const override { return config_.fluid; }
  bool sticks_to_walls() const override { return config_.wall_slip == WallSlip::no_slip; }
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
  void set_bodies(std::span<const FluidBody> bodies) override;
  const std::vector<BodyLoad>& body_loads() const override { return body_loads_; }
  const std::vector<WallLoad>& wall_loads() const override { return loads_; }
  Vec3 momentum() const override;
  Vec3 impulse_from_gravity() const override { return gravity_impulse_; }
  Vec3 momentum_added() const override { return momentum_added_; }
  Vec3 momentum_removed() const override { return momentum_removed_; }
  double kinetic_energy() const override;
  double kinetic_added() const override { return kinetic_added_; }
  double kinetic_removed() const override { return kinetic_removed_; }
  double largest_speed() const override { return largest_speed_; }
  double wall_work() const override { return wall_work_; }
  double total_mass() const override;
  double total_fines() const override;
  std::uint64_t state_hash() const override;
  std::size_t memory_bytes() const override;
  void exchange(StateArchive& archive) override;

 private:
  using Point = MaterialPoint<Real>;
  using Place = typename PointStore<Real>::Place;
  using Node = Lanes<Real>;
  using Vector = Quad<Real>;  ///< three components

  /// What all points share in a step.
  struct StepNumbers {
    double t = 0, dt = 0;
    double t_velocity = 0;    ///< in which points forget what the grid does not know [s]
    Real relax_velocity = 0;  ///< a: share of it that goes in a step
    Real relax_dilation = 0;
    Real anchor = 0;        ///< dt / t_R
    Real shift = 0;         ///< per fill gradient [cells]
    Real h = 0, per_h = 0;  ///< grid spacing, and 4 / h: what a first moment means for C
    Real c2 = 0;            ///< of the speed of sound
    Real stress = 0;        ///< 4 dt / h
    Real dt_real = 0;
    Real cells_per_speed = 0;     ///< dt / h
    Real dilation_per_speed = 0;  ///< h / (dt c2)
  };
  /// Nodes around a block, with what only the place knows.
  struct NodeTile {
    Node node[BlockLayout::tile_nodes];
    Real void_fraction[BlockLayout::tile_nodes];
    Vector blend[BlockLayout::tile_nodes];  ///< as NodeBlocks::blend
    Real least_fill[BlockLayout::nodes];    ///< over the 27 nodes of each cell
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
  /// What a point gives its nodes at (i, j, k) in {-1, 0, 1}: w (middle + i slope_0 + j slope_1 + k slope_2).
  struct Contribution {
    Node middle, slope[3];
    Vector shared;     ///< m misfit, m rate of shear: w times it
    Vector weight[9];  ///< of nodes i, per j + 3 k; the fourth is 0
  };
  /// What a thread needs to scatter or move a block.
  struct ScatterScratch {
    static constexpr int batch = 16;
    Node tile[BlockLayout::tile_nodes];
    Vector blend[BlockLayout::tile_nodes];
    Contribution point[batch];
    typename Node::Half strain[BlockLayout::tile_nodes];  ///< as NodeBlocks::strain
  };
  /// What a point gathers from its 27 nodes: weighted sums, and sums of w d with d in cells.
  struct Gathered {
    Vector change;     ///< of v [m/s]
    Vector velocity;   ///< b v_old [m/s], b
    Vector blend;      ///< as NodeBlocks::blend
    Vector pressure;   ///< change of v by pressure alone [m/s]
    Vector centre;     ///< mean x_p - x_i there [cells]
    Vector moment[3];  ///< of change + velocity, by columns like C [m/s]
    Real bulk, pull, fill, dilation, least_fill;
    Real bulk_moment[3], fill_moment[3], blend_moment[3];
    bool knows_all;       ///< of C; else `kept` stays
    bool beside_wall;     ///< walls hide nodes
    bool in_gap = false;  ///< between walls that all but touch
    Real kept[6];         ///< of C: I - 4 sum b w d d^T, as xx yy zz yz xz xy
  };
  struct GatherScratch {
    static constexpr int batch = 16;
    NodeTile tile;
    Gathered gathered[batch];
    Vector moved[batch];
  };

  template <class Leaves>
  std::vector<RemovedPoint> remove_slots(const Leaves& leaves);
  void find_faces();
  void place_walls(double t, double dt);
  void prepare_block(std::int32_t slot);
  void scatter_block(std::size_t index, ScatterScratch& scratch);
  void scatter(std::span<const Contribution> points, Node* corner) const;
  void scatter_shared(std::span<const Contribution> points, Vector* corner) const;
  void contribute(const Point& p, const Vector& misfit, Contribution& a) const;
  Real sheared_viscosity(const Point& p) const;
  bool hide_nodes(const Point& p, std::int32_t cell_key, std::int32_t stencil, Contribution& a,
                  WallImpulses& impulses) const;
  void colour_blocks();
  void scatter_strain(const Point& p, const Contribution& a, bool beyond_edge,
                      typename Node::Half* corner) const;
  void add_tile(const PointBlock& block, const Node* tile, const Vector* blend);
  void add_strain(const PointBlock& block, const typename Node::Half* strain);
  std::uint32_t finish_nodes(std::int32_t slot);
  void wall_block(std::int32_t slot, std::uint32_t first, WallImpulses& impulses);
  /// Water about a node as the walls beside it need it.
  struct WaterBeside {
    double volume = 0;           ///< that the node stands for [m3]
    double chi = 0;              ///< share of it that has the wall before it, not a free edge's open side
    Mat3 strain = Mat3::Zero();  ///< mean of (C + C^T) / 2 [1/s]
  };
  void close_pressure(Node& node, const WaterBeside& water, std::span<const WallPlane> planes, const Vec3& at,
                      WallImpulses& impulses) const;
  void hold_at_walls(Node& node, const WaterBeside& water, Vec3 cut_off, std::span<const WallPlane> planes,
                     const Vec3& at, WallImpulses& impulses) const;
  /// Calls row(slot, node, tile_node, length) for each row of nodes, along the first axis, of a block's tile:
  /// where it lies in a grid block and where in the tile.
  template <class Row>
  void visit_tile(const PointBlock& block, const Row& row) const;
  void load_tile(const PointBlock& block, NodeTile& tile) const;
  void move_block(std::size_t index, GatherScratch& scratch);
  void move_cell(std::span<const std::uint32_t> slots, std::size_t index, std::int32_t stencil,
                 GatherScratch& scratch, BlockReport& report);
  void share_step(double dt);
  bool note(const Point& p, const Gathered& g, const Vector& moved, std::uint32_t slot,
            BlockReport& report) const;
  void gather_near_wall(const Point& p, const Vector& misfit, std::int32_t cell_key, std::int32_t stencil,
                        const NodeTile& tile, Gathered& g, WallImpulses& impulses) const;
  void gather(const Point& p, int local, const NodeTile& tile, Gathered& g) const;
  void gather_kept(const Point& p, int local, const NodeTile& tile, Gathered& g) const;
  Real gather_void_fraction(const Point& p, int local, const NodeTile& tile) const;
  Vector update(Point& p, BriefVector<Real>& misfit, const Gathered& g) const;
  void carry_in_gap(Point& p, BriefVector<Real>& misfit, Vector& moved, std::int32_t cell_key,
                    std::int32_t stencil, WallImpulses& impulses) const;
  void stop_at_walls(Point& p, const Place& before, std::int32_t cell_key, std::int32_t stencil,
                     WallImpulses& impulses) const;
  std::optional<WallHit> first_hit(std::int32_t stencil, const Vec3& from, const Vec3& to) const;
  std::optional<WallHit> hit_of_body(int body, const Vec3& from, const Vec3& to) const;
  void settle_in_cell(Point& p, Place& before, std::int32_t& cell_key) const;
  int colour_of(const Vec3i& place) const;
  void check_reports();
  void pour_loads(std::size_t lists);

  /// Where a stencil's record of walls is: in the field of what stands, or in that of what moves.
  struct WallRecord {
    const WallField* field = nullptr;
    int stencil = -1;
  };
  static constexpr std::int32_t first_moving = 1
                                               << 28;  ///< stencils from here on are of the field that moves
  WallRecord record_of(std::int32_t stencil) const {
    if (stencil < first_moving) return {field_.get(), stencil};
    return {moving_field_.get(), stencil - first_moving};
  }
  bool has_walls() const { return field_ || moving_field_; }
  Real open_fraction(std::int32_t slot, int node) const {
    const std::int32_t stencil = grid_.stencil(slot)[node];
    if (stencil < 0) return Real(1);
    const WallRecord record = record_of(stencil);
    return static_cast<Real>(record.field->open_fraction_at(record.stencil));
  }
  Vec3 velocity_of(const Point& p) const { return Vec3(p.v[0], p.v[1], p.v[2]); }
  /// By volume; fines are what makes the fluid denser. @param density  without pressure [kg/m3]
  double fines_at(double density) const {
    return store_.fines.empty() ? 0.0 : fines_fraction(config_.fluid, density);
  }
  /// Of fluid at a node [Pa s]. @param rate  of shear [1/s]
  double viscosity_of(double density, double rate) const {
    const FluidModel& fluid = config_.fluid;
    const double phi = fines_at(density);
    return yields_ ? apparent_viscosity(fluid, flow_curve(fluid, phi), rate) : slurry_viscosity(fluid, phi);
  }
  double fines_of(std::size_t slot) const { return store_.fines.empty() ? 0.0 : store_.fines[slot]; }
  template <class Triple>
  Vec3 position(const Triple& x, std::int32_t cell_key) const {
    return layout_.origin() +
           config_.spacing * (layout_.cell_of(cell_key).template cast<double>() + Vec3(x[0], x[1], x[2]));
  }

  MpmConfig config_;
  Domain domain_;
  Vec3 gravity_;
  const Walls& walls_;
  WallPoses poses_;
  FluidStepLimits limits_;
  double sound_speed_ = 0;
  BlockLayout layout_;
  PointStore<Real> store_;
  NodeBlocks<Real> grid_;
  std::vector<char> at_face_;                ///< per block of the domain: a point of it may lie outside
  std::unique_ptr<WallField> field_;         ///< of walls that stand; absent without
  std::unique_ptr<WallField> moving_field_;  ///< of walls and bodies that move and what stands beside them
  std::array<Vec3i, 2> looked_at_{Vec3i::Zero(), Vec3i::Zero()};  ///< nodes that the field that moves knows

  StepNumbers step_;
  std::vector<ScatterScratch> scatter_scratch_;      ///< per thread
  std::vector<GatherScratch> gather_scratch_;        ///< per thread
  std::vector<std::vector<std::uint32_t>> colours_;  ///< point blocks that may scatter at the same time
  std::vector<std::uint32_t> node_begin_{
      0};                               ///< index of the first node with mass per active block, and the end
  std::vector<Vec3> impulse_;           ///< from the coupling, in the order of read_nodes; empty = none
  std::vector<WallImpulses> impulses_;  ///< per block
  std::vector<BlockReport> reports_;
  bool has_void_ = false;
  bool yields_ = false;  ///< viscosity depends on the rate of shear

  std::uint64_t next_id_ = 0;
  double largest_kinematic_viscosity_ = 0;
  double largest_speed_ = 0;
  Vec3 gravity_impulse_ = Vec3::Zero();
  Vec3 momentum_added_ = Vec3::Zero(), momentum_removed_ = Vec3::Zero();
  double kinetic_added_ = 0, kinetic_removed_ = 0;
  double wall_work_ = 0;
  std::vector<WallLoad> loads_;
  std::vector<BodyLoad> body_loads_;
};

template <class Real>
template <class Row>
void ExplicitMpm<Real>::visit_tile(const PointBlock& block, const Row& row) const {
  const Vec3i place = layout_.block_place(block.block);
  const Vec3i width = layout_.width(place);
  for (int bit = 0; bit < 27; ++bit) {
    if (!(block.reach >> bit & 1)) continue;
    const int step[3] = {bit % 3 - 1, bit / 3 % 3 - 1, bit / 9 - 1};
    const std::int32_t there = layout_.neighbour(place, step[0], step[1], step[2]);
    if (there == BlockLayout::none) continue;
    const Vec3i width_there = layout_.width(layout_.block_place(there));
    // Tile index along an axis: 0 is the neighbour below, 1..width this block, width + 1 the one above.
    int lo[3], hi[3], shift[3];
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = step[axis] < 0 ? 0 : step[axis] == 0 ? 1 : width[axis] + 1;
      hi[axis] = step[axis] == 0 ? width[axis] + 1 : lo[axis] + 1;
      shift[axis] = step[axis] < 0 ? width_there[axis] - 1 : -lo[axis];
    }
    const std::int32_t slot = grid_.slot_of(there);
    for (int k = lo[2]; k < hi[2]; ++k)
      for (int j = lo[1]; j < hi[1]; ++j)
        row(slot, lo[0] + shift[0] + 4 * (j + shift[1]) + 16 * (k + shift[2]), lo[0] + 6 * j + 36 * k,
            hi[0] - lo[0]);
  }
}

}  // namespace sluice
