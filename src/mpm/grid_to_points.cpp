#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/parallel.h"
#include "mpm/explicit_mpm.h"
#include "mpm/spline_sums.h"

namespace sluice {

namespace {
constexpr double full_for_anchor = 0.8;  ///< least fill around a point for the density to pull at J
constexpr double full_for_shift = 0.95;  ///< least fill for the points to be spread evenly
constexpr double spray_fill = 0.3;       ///< below this the water has no pressure
constexpr double open_below = 0.5, held_above = 0.8;  ///< least fill around a point for tension: none, all
constexpr double largest_stretch = 2e-3;              ///< J - 1 of water under tension
constexpr double largest_shift = 0.02;                ///< [cells]
constexpr double largest_move = 0.5;   ///< per step and axis: the reach of a stencil's walls [cells]
constexpr double largest_mach = 0.32;  ///< v/c at which the density error v2/(2 c2) is 5 %

/// How far water may stretch before it opens. Air reaches it at a free surface, where it pulls at nothing; a
/// body of water that is stretched holds together against the air's pressure and grows thinner. From walls it
/// may part.
/// @param least_fill  of the nodes around
template <class Real>
Real stretch_held(Real least_fill) {
  const Real ramp = static_cast<Real>(1 / (held_above - open_below));
  return Real(largest_stretch) * std::clamp((least_fill - Real(open_below)) * ramp, Real(0), Real(1));
}

/// Least value over the 27 nodes of each cell, axis by axis.
/// @param of  each node of a tile, 6 x 6 x 6
template <class Real>
void least_of_cells(const Real* of, Real* least) {
  Real by_x[6 * 6 * 4], by_y[6 * 4 * 4];
  const auto least_of_three = [](const Real* x, int step) { return std::min({x[0], x[step], x[2 * step]}); };
  for (int row = 0; row < 36; ++row)
    for (int i = 0; i < 4; ++i) by_x[4 * row + i] = least_of_three(of + 6 * row + i, 1);
  for (int layer = 0; layer < 6; ++layer)
    for (int n = 0; n < 16; ++n) by_y[16 * layer + n] = least_of_three(by_x + 24 * layer + n, 4);
  for (int n = 0; n < 64; ++n) least[n] = least_of_three(by_y + n, 16);
}
}  // namespace

template <class Real>
void ExplicitMpm<Real>::grid_to_points(double dt) {
  share_step(dt);
  const std::size_t blocks = store_.blocks().size();
  parallel_chunks_with(gather_scratch_, blocks, 1,
                       [&](GatherScratch& scratch, std::size_t, std::size_t b, std::size_t) {
                         load_tile(store_.blocks()[b], scratch.tile);
                         move_block(b, scratch);
                       });
  if (has_walls()) pour_loads(blocks);
  check_reports();
}

template <class Real>
void ExplicitMpm<Real>::load_tile(const PointBlock& block, NodeTile& tile) const {
  for (Node& n : tile.node) n.clear();
  std::fill_n(tile.blend, BlockLayout::tile_nodes, Vector{});
  if (has_void_) std::fill_n(tile.void_fraction, BlockLayout::tile_nodes, Real(1));
  visit_tile(block, [&](std::int32_t slot, int from, int to, int length) {
    const Node* nodes = grid_.nodes(slot);
    const Real* voids = grid_.void_fraction(slot);
    const Vector* blend = grid_.blend(slot);
    for (int n = 0; n < length; ++n) tile.blend[to + n] = blend[from + n];
    if (length == BlockLayout::edge)
      for (int n = 0; n < BlockLayout::edge; ++n) tile.node[to + n] = nodes[from + n];
    else
      for (int n = 0; n < length; ++n) tile.node[to + n] = nodes[from + n];
    if (!has_void_) return;
    for (int n = 0; n < length; ++n) {
      // Rocks push on the water only where both together fill the space.
      const Real ramp =
          std::clamp((nodes[from + n][node_lane::fill] - Real(0.8)) / Real(0.15), Real(0), Real(1));
      tile.void_fraction[to + n] = 1 - ramp * (1 - voids[from + n]);
    }
  });
  Real fill[BlockLayout::tile_nodes];
  for (int n = 0; n < BlockLayout::tile_nodes; ++n) fill[n] = tile.node[n][node_lane::fill];
  least_of_cells(fill, tile.least_fill);
}

template <class Real>
void ExplicitMpm<Real>::gather(const Point& p, int local, const NodeTile& tile, Gathered& g) const {
  using namespace node_lane;
  const int corner = (local & 3) + 6 * ((local >> 2) & 3) + 36 * (local >> 4);
  Node sum;
  typename Node::Half moment[3];
  spline_sums<6, 36>(tile.node + corner, p.x, sum, moment);
  g.change = sum.quad(1);
  g.centre = sum.quad(2);
  g.pressure = sum.quad(3);
  for (int c = 0; c < 3; ++c) {
    g.moment[c] = sum_of_quads<Real>(moment[c]);
    g.bulk_moment[c] = moment[c][node_lane::mass];
    g.fill_moment[c] = moment[c][fill];
  }
  g.velocity = sum.quad(0);
  g.blend = spline_sum_of_quads<6, 36>(tile.blend + corner, p.x, g.blend_moment);
  g.bulk = sum[node_lane::mass];
  g.pull = sum[near_wall];
  g.fill = sum[fill];
  g.dilation = sum[dilation];
  g.least_fill = tile.least_fill[local];
  g.beside_wall = false;
  gather_kept(p, local, tile, g);
}

/// Nodes pull at a point's C with b w d (x) d, so that much of C is what they know of it. With b times I / 4
/// instead, C would grow where b differs from node to node, as at the edge of a spray: a lone point finds its
/// own C on the grid, and what it gets back must not exceed what it gives up.
template <class Real>
void ExplicitMpm<Real>::gather_kept(const Point& p, int local, const NodeTile& tile, Gathered& g) const {
  g.knows_all = g.bulk > 1 - Real(1e-5);  // float sums of weights end here
  if (g.knows_all) return;
  for (int r = 0; r < 6; ++r) g.kept[r] = r < 3 ? Real(1) : Real(0);
  if (!(g.bulk > 0)) return;
  const Node* corner = tile.node + (local & 3) + 6 * ((local >> 2) & 3) + 36 * (local >> 4);
  const SplineWeights<Real> x(p.x[0]), y(p.x[1]), z(p.x[2]);
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const Real b = corner[i + 6 * j + 36 * k][node_lane::mass];
        const Real known = 4 * b * x.w[i] * y.w[j] * z.w[k];
        g.kept[0] -= known * x.d[i] * x.d[i];
        g.kept[1] -= known * y.d[j] * y.d[j];
        g.kept[2] -= known * z.d[k] * z.d[k];
        g.kept[3] -= known * y.d[j] * z.d[k];
        g.kept[4] -= known * x.d[i] * z.d[k];
        g.kept[5] -= known * x.d[i] * y.d[j];
      }
}

/// Where the viscosity depends on the rate of shear [Pa s].
template <class Real>
Real ExplicitMpm<Real>::sheared_viscosity(const Point& p) const {
  const double density = static_cast<double>(p.mass() / p.volume());
  const FlowCurve curve = flow_curve(config_.fluid, fines_at(density));
  return static_cast<Real>(apparent_viscosity(config_.fluid, curve, static_cast<double>(rate_of_shear(p))));
}

/// New velocity, C and J of a point, and how far it moves [cells].
template <class Real>
auto ExplicitMpm<Real>::update(Point& p, BriefVector<Real>& misfit, const Gathered& g) const -> Vector {
  const Real* bulk = g.bulk_moment;
  const Vector old = p.v;
  const auto own = [&](Real sum, const Real* moment) -> Vector {
    return sum * old + step_.h * (moment[0] * p.C[0] + moment[1] * p.C[1] + moment[2] * p.C[2]);
  };
  const Vector to_grid = g.velocity - own(g.bulk, bulk);
  const Vector pulled = g.blend - own(g.blend[3], g.blend_moment) + (g.pull - g.blend[3]) * misfit.quad();
  misfit = BriefVector<Real>((g.bulk > 0 ? g.pull / g.bulk : Real(0)) * to_grid);
  const Vector v = old + g.change;
  const Real eased = g.bulk > 0 ? g.pull / g.bulk : Real(0);
  Vector moved = step_.cells_per_speed * (v + eased * to_grid);
  p.v = with_fourth(v + step_.relax_velocity * pulled, old[3]);
  Vector C[3];
  for (int c = 0; c < 3; ++c) C[c] = step_.per_h * (g.moment[c] - bulk[c] * old);
  if (!g.knows_all) {
    // What the grid does not know of C stays as it was.
    const Real* kept = g.kept;
    C[0] += kept[0] * p.C[0] + kept[5] * p.C[1] + kept[4] * p.C[2];
    C[1] += kept[5] * p.C[0] + kept[1] * p.C[1] + kept[3] * p.C[2];
    C[2] += kept[4] * p.C[0] + kept[3] * p.C[1] + kept[2] * p.C[2];
  }
  for (int c = 0; c < 3; ++c) p.C[c] = with_fourth(C[c], p.C[c][3]);

  // J: average of the departure from the local pressure gradient, then the flow, then the density's pull.
  // The pressure's acceleration is c2 grad J over the void fraction.
  const Vector slope = step_.dilation_per_speed * p.void_fraction() * g.pressure;  // of J per cell
  const Real mean = g.dilation - dot3(slope, g.centre);
  Real e = p.dilation() + step_.relax_dilation * (mean - p.dilation());
  e += (1 + e) * step_.dt_real * (C[0][0] + C[1][1] + C[2][2]);
  if (g.least_fill > Real(full_for_anchor)) {
    // Where it is too thin the flow has stretched it, or only the points' places say so: those make no
    // tension.
    const Real anchored = e - (1 + e) * step_.anchor * (g.fill - 1);
    e = config_.keep_tension || anchored < e ? anchored : std::max(e, std::min(anchored, Real(0)));
  }
  if (g.least_fill > Real(full_for_shift)) {
    Vector s = {g.fill_moment[0], g.fill_moment[1], g.fill_moment[2], 0};
    s *= -4 * step_.shift;
    const Real length2 = dot3(s, s), most = Real(largest_shift);
    if (length2 > most * most) s *= most / std::sqrt(length2);
    moved += s;
    e += dot3(s, slope);
  }
  if (!config_.keep_tension) {
    const Real stretch = g.beside_wall ? Real(0) : stretch_held(g.least_fill);
    e = g.fill < Real(spray_fill) ? Real(0) : std::min(e, stretch);
  }
  p.x[3] = e;
  return moved;
}

template <class Real>
void ExplicitMpm<Real>::move_block(std::size_t index, GatherScratch& scratch) {
  const std::int32_t* stencil = grid_.stencil(grid_.slot_of(store_.blocks()[index].block));
  BlockReport report;
  for (int local = 0; local < BlockLayout::nodes; ++local)
    for (std::span<const std::uint32_t> slots = store_.of_cell(index, local); !slots.empty();) {
      const std::size_t count = std::min<std::size_t>(slots.size(), GatherScratch::batch);
      move_cell(slots.first(count), index, stencil[local], scratch, report);
      slots = slots.subspan(count);
    }
  report.mass = reports_[index].mass;
  reports_[index] = report;
}

/// Moves points of one cell. Each stage is a loop of its own: what one point waits for, the next one fills.
template <class Real>
void ExplicitMpm<Real>::move_cell(std::span<const std::uint32_t> slots, std::size_t index,
                                  std::int32_t stencil, GatherScratch& scratch, BlockReport& report) {
  const std::size_t count = slots.size();
  const int local = store_.key[slots[0]] & 63;
  for (std::size_t n = 0; n < count; ++n) {
    Point& p = store_.points[slots[n]];
    Gathered& g = scratch.gathered[n];
    if (stencil >= 0)
      gather_near_wall(p, store_.misfit[slots[n]].quad(), store_.key[slots[n]], stencil, scratch.tile, g,
                       impulses_[index]);
    else
      gather(p, local, scratch.tile, g);
    if (has_void_) p.C[2][3] = gather_void_fraction(p, local, scratch.tile);
  }
  for (std::size_t n = 0; n < count; ++n)
    scratch.moved[n] = update(store_.points[slots[n]], store_.misfit[slots[n]], scratch.gathered[n]);
  if (stencil >= 0)
    for (std::size_t n = 0; n < count; ++n)
      if (scratch.gathered[n].in_gap)
        carry_in_gap(store_.points[slots[n]], store_.misfit[slots[n]], scratch.moved[n], store_.key[slots[n]],
                     stencil, impulses_[index]);
  if (yields_)
    for (const std::uint32_t slot : slots) {
      Point& p = store_.points[slot];
      p.C[1][3] = sheared_viscosity(p);
    }
  for (std::size_t n = 0; n < count; ++n) {
    const std::uint32_t slot = slots[n];
    Point& p = store_.points[slot];
    std::int32_t& cell_key = store_.key[slot];
    if (!note(p, scratch.gathered[n], scratch.moved[n], slot, report)) continue;
    Place& before = store_.before[slot];
    before = {p.x[0], p.x[1], p.x[2]};
    p.x = with_fourth(quantised<Real>(p.x + scratch.moved[n]), p.x[3]);
    if (stencil >= 0) stop_at_walls(p, before, cell_key, stencil, impulses_[index]);
    settle_in_cell(p, before, cell_key);
    if (cell_key == BlockLayout::none) {
      report.left_grid = true;
      report.culprit = slot;
    }
  }
}

/// Keeps the block's largest speeds; false where the point must not move.
template <class Real>
bool ExplicitMpm<Real>::note(const Point& p, const Gathered& g, const Vector& moved, std::uint32_t slot,
                             BlockReport& report) const {
  const Real speed2 = dot3(p.v, p.v);
  const Real move = std::max({std::abs(moved[0]), std::abs(moved[1]), std::abs(moved[2])});
  const bool finite = std::isfinite(dot3(moved, moved) + speed2);
  if (!finite || move > Real(largest_move)) {
    if (!report.stopped) report = {.stopped = true, .finite = finite, .move = move, .culprit = slot};
    return false;
  }
  if (speed2 > report.speed2) report.speed2 = speed2;
  if (speed2 > report.bulk_speed2 && g.bulk > Real(0.5) && g.fill > Real(full_for_anchor)) {
    report.bulk_speed2 = speed2;
    report.fastest_bulk = slot;
  }
  return true;
}

/// Takes the point's nearest node as its cell.
template <class Real>
void ExplicitMpm<Real>::settle_in_cell(Point& p, Place& before, std::int32_t& cell_key) const {
  if (std::max({std::abs(p.x[0]), std::abs(p.x[1]), std::abs(p.x[2])}) <= Real(0.5)) return;
  Vec3i step = Vec3i::Zero();
  for (int r = 0; r < 3; ++r) {
    if (p.x[r] > Real(0.5)) step[r] = 1;
    if (p.x[r] < Real(-0.5)) step[r] = -1;
    p.x[r] -= static_cast<Real>(step[r]);
    before[static_cast<std::size_t>(r)] -= static_cast<Real>(step[r]);
  }
  cell_key = layout_.key(layout_.cell_of(cell_key) + step);
}

template <class Real>
Real ExplicitMpm<Real>::gather_void_fraction(const Point& p, int local, const NodeTile& tile) const {
  const Real* corner = tile.void_fraction + (local & 3) + 6 * ((local >> 2) & 3) + 36 * (local >> 4);
  const SplineWeights<Real> x(p.x[0]), y(p.x[1]), z(p.x[2]);
  Real sum = 0;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) sum += x.w[i] * y.w[j] * z.w[k] * corner[i + 6 * j + 36 * k];
  return sum;
}

template <class Real>
void ExplicitMpm<Real>::check_reports() {
  Real speed2 = 0, bulk2 = 0;
  std::uint32_t fastest_bulk = 0;
  const double now = step_.t + step_.dt;
  for (const BlockReport& r : reports_) {
    const auto number = static_cast<unsigned long long>(store_.id[r.culprit]);
    if (r.stopped && !r.finite)
      throw NumericalError("water.grid_to_points", now,
                           fmt::format("point {} has no finite velocity", number),
                           config_.sound_speed ? "lower 'courant' or raise 'sound_speed'"
                                               : "lower 'courant' or raise 'fastest_bulk_speed'");
    if (r.stopped)
      throw NumericalError("water.grid_to_points", now,
                           fmt::format("point {} moves {:.2g} cells in a step (limit {})", number,
                                       static_cast<double>(r.move), largest_move),
                           "raise 'fastest_speed' or lower 'courant'");
    if (r.left_grid)
      throw NumericalError("water.grid_to_points", now,
                           fmt::format("point {} left the grid around the domain", number),
                           "remove points beyond open faces every step");
    speed2 = std::max(speed2, r.speed2);
    if (r.bulk_speed2 > bulk2) {
      bulk2 = r.bulk_speed2;
      fastest_bulk = r.fastest_bulk;
    }
  }
  largest_speed_ = std::sqrt(static_cast<double>(speed2));
  const double bulk = std::sqrt(static_cast<double>(bulk2));
  if (bulk > largest_mach * sound_speed_)
    throw NumericalError(
        "water.grid_to_points", now,
        fmt::format("point {} in bulk water has {:.4g} m/s, a density error above 5 % (limit {:.4g} m/s)",
                    static_cast<unsigned long long>(store_.id[fastest_bulk]), bulk,
                    largest_mach * sound_speed_),
        config_.sound_speed ? "raise 'sound_speed'" : "raise 'fastest_bulk_speed'");
}

template void ExplicitMpm<float>::grid_to_points(double);
template void ExplicitMpm<float>::gather(const Point&, int, const NodeTile&, Gathered&) const;
template void ExplicitMpm<double>::grid_to_points(double);
template void ExplicitMpm<double>::gather(const Point&, int, const NodeTile&, Gathered&) const;

}  // namespace sluice
