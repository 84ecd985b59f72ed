#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/parallel.h"
#include "mpm/explicit_mpm.h"
#include "mpm/spline_weights.h"

namespace sluice {

namespace {
constexpr double full_for_anchor = 0.8;  ///< least fill around a point for the density to pull at J
constexpr double full_for_shift = 0.95;  ///< least fill for the points to be spread evenly
constexpr double spray_fill = 0.3;       ///< below this the water has no pressure
constexpr double largest_shift = 0.02;   ///< [cells]
constexpr double largest_move = 0.5;     ///< per step and axis: the reach of a stencil's walls [cells]
constexpr double largest_mach = 0.32;    ///< v/c at which the density error v2/(2 c2) is 5 %
}  // namespace

template <class Real>
void ExplicitMpm<Real>::grid_to_points(double dt) {
  step_.dt = dt;
  const std::size_t blocks = store_.blocks().size();
  parallel_for(
      blocks,
      [&](std::size_t b) {
        NodeTile tile;
        load_tile(store_.blocks()[b], tile);
        move_block(b, tile);
      },
      1);
  if (field_) pour_loads(blocks);
  check_reports();
}

template <class Real>
void ExplicitMpm<Real>::load_tile(const PointBlock& block, NodeTile& tile) const {
  const Vec3i place = layout_.block_place(block.block);
  const Vec3i width = layout_.width(place);
  for (Node& n : tile.node) n.clear();
  if (has_void_) std::fill_n(tile.void_fraction, BlockLayout::tile_nodes, Real(1));
  for (int bit = 0; bit < 27; ++bit) {
    if (!(block.reach >> bit & 1)) continue;
    const int step[3] = {bit % 3 - 1, bit / 3 % 3 - 1, bit / 9 - 1};
    const std::int32_t from = layout_.neighbour(place, step[0], step[1], step[2]);
    if (from == BlockLayout::none) continue;
    const std::int32_t slot = grid_.slot_of(from);
    const Node* nodes = grid_.nodes(slot);
    const Real* voids = grid_.void_fraction(slot);
    const Vec3i from_width = layout_.width(layout_.block_place(from));
    // Tile index along an axis: 0 is the neighbour below, 1..width this block, width + 1 the one above.
    int lo[3], hi[3], shift[3];
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = step[axis] < 0 ? 0 : step[axis] == 0 ? 1 : width[axis] + 1;
      hi[axis] = step[axis] == 0 ? width[axis] + 1 : lo[axis] + 1;
      shift[axis] = step[axis] < 0 ? from_width[axis] - 1 : -lo[axis];
    }
    for (int k = lo[2]; k < hi[2]; ++k)
      for (int j = lo[1]; j < hi[1]; ++j)
        for (int i = lo[0]; i < hi[0]; ++i) {
          const int source = i + shift[0] + 4 * (j + shift[1]) + 16 * (k + shift[2]);
          const int n = i + 6 * j + 36 * k;
          tile.node[n] = nodes[source];
          if (!has_void_) continue;
          // Rocks push on the water only where both together fill the space.
          const Real ramp =
              std::clamp((nodes[source][node_lane::fill] - Real(0.8)) / Real(0.15), Real(0), Real(1));
          tile.void_fraction[n] = 1 - ramp * (1 - voids[source]);
        }
  }
  for (int local = 0; local < BlockLayout::nodes; ++local) {
    const int corner = (local & 3) + 6 * ((local >> 2) & 3) + 36 * (local >> 4);
    Real least = tile.node[corner][node_lane::fill];
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          least = std::min(least, tile.node[corner + i + 6 * j + 36 * k][node_lane::fill]);
    tile.least_fill[local] = least;
  }
}

template <class Real>
void ExplicitMpm<Real>::gather(const Point& p, int local, const NodeTile& tile, Gathered& g) const {
  using namespace node_lane;
  const Node* corner = tile.node + (local & 3) + 6 * ((local >> 2) & 3) + 36 * (local >> 4);
  const SplineWeights<Real> x(p.x[0]), y(p.x[1]), z(p.x[2]);
  const Real wdx[3] = {x.w[0] * x.d[0], x.w[1] * x.d[1], x.w[2] * x.d[2]};
  Node sum, sum_x, sum_y, sum_z;
  sum.clear(), sum_x.clear(), sum_y.clear(), sum_z.clear();
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) {
      const Node* row = corner + 6 * j + 36 * k;
      const Real w = y.w[j] * z.w[k], wy = w * y.d[j], wz = w * z.d[k];
      for (int r = 0; r < Node::registers; ++r) {
        const auto plain = x.w[0] * row[0].part[r] + x.w[1] * row[1].part[r] + x.w[2] * row[2].part[r];
        const auto first = wdx[0] * row[0].part[r] + wdx[1] * row[1].part[r] + wdx[2] * row[2].part[r];
        sum.part[r] += w * plain;
        sum_x.part[r] += w * first;
        sum_y.part[r] += wy * plain;
        sum_z.part[r] += wz * plain;
      }
    }
  const Node* by_axis[3] = {&sum_x, &sum_y, &sum_z};
  for (int r = 0; r < 3; ++r) {
    g.change[r] = sum[change + r];
    g.velocity[r] = sum[velocity + r];
    g.pressure[r] = sum[gradient + r];
    g.centre[r] = sum[centre + r];
    g.bulk_moment[r] = (*by_axis[r])[node_lane::mass];
    g.fill_moment[r] = (*by_axis[r])[fill];
    for (int c = 0; c < 3; ++c) g.moment[3 * r + c] = (*by_axis[c])[change + r] + (*by_axis[c])[velocity + r];
  }
  g.bulk = sum[node_lane::mass];
  g.fill = sum[fill];
  g.dilation = sum[dilation];
  g.least_fill = tile.least_fill[local];
  gather_kept(p, local, tile, g);
}

/// Nodes pull at a point's C with b w d (x) d, so that much of C is what they know of it. With b times I / 4
/// instead, C would grow where b differs from node to node, as at the edge of a spray: a lone point finds its
/// own C on the grid, and what it gets back must not exceed what it gives up.
template <class Real>
void ExplicitMpm<Real>::gather_kept(const Point& p, int local, const NodeTile& tile, Gathered& g) const {
  for (Real& kept : g.kept) kept = 0;
  if (g.bulk > 1 - Real(1e-5)) return;  // all of C is known; float sums of weights end here
  for (int r = 0; r < 3; ++r) g.kept[r] = 1;
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

/// New velocity, C and J of a point, and how far it moves [cells].
template <class Real>
void ExplicitMpm<Real>::update(Point& p, const Gathered& g, Real (&moved)[3]) const {
  const Real h = static_cast<Real>(config_.spacing), dt = static_cast<Real>(step_.dt);
  const Real c2 = static_cast<Real>(sound_speed_ * sound_speed_);
  const Real a = step_.relax_velocity;
  for (int r = 0; r < 3; ++r) {
    Real own = g.bulk * p.v[r];
    for (int c = 0; c < 3; ++c) own += h * p.C[3 * r + c] * g.bulk_moment[c];
    const Real to_grid = g.velocity[r] - own;
    const Real v = p.v[r] + g.change[r];
    moved[r] = (v + to_grid) * dt / h;
    const Real old = p.v[r];
    p.v[r] = v + a * to_grid;
    // What the grid does not know of C stays as it was.
    const Real row[3] = {p.C[3 * r], p.C[3 * r + 1], p.C[3 * r + 2]};
    const Real kept[3] = {g.kept[0] * row[0] + g.kept[5] * row[1] + g.kept[4] * row[2],
                          g.kept[5] * row[0] + g.kept[1] * row[1] + g.kept[3] * row[2],
                          g.kept[4] * row[0] + g.kept[3] * row[1] + g.kept[2] * row[2]};
    for (int c = 0; c < 3; ++c)
      p.C[3 * r + c] = kept[c] + 4 / h * (g.moment[3 * r + c] - old * g.bulk_moment[c]);
  }

  // J: average of the departure from the local pressure gradient, then the flow, then the density's pull.
  Real slope[3];  // of J per cell; the pressure's acceleration is c2 grad J over the void fraction
  Real mean = g.dilation;
  for (int r = 0; r < 3; ++r) {
    slope[r] = g.pressure[r] * p.void_fraction * h / (dt * c2);
    mean -= slope[r] * g.centre[r];
  }
  Real e = p.dilation + step_.relax_dilation * (mean - p.dilation);
  e += (1 + e) * dt * (p.C[0] + p.C[4] + p.C[8]);
  if (g.least_fill > Real(full_for_anchor)) e -= (1 + e) * step_.anchor * (g.fill - 1);
  if (g.least_fill > Real(full_for_shift)) {
    Real s[3], length2 = 0;
    for (int r = 0; r < 3; ++r) {
      s[r] = -step_.shift * 4 * g.fill_moment[r];
      length2 += s[r] * s[r];
    }
    const Real most = Real(largest_shift);
    const Real cut = length2 > most * most ? most / std::sqrt(length2) : Real(1);
    for (int r = 0; r < 3; ++r) {
      moved[r] += cut * s[r];
      e += cut * s[r] * slope[r];
    }
  }
  if (!config_.keep_tension) e = g.fill < Real(spray_fill) ? Real(0) : std::min(e, Real(0));
  p.dilation = e;
  p.fill = g.fill;
}

template <class Real>
void ExplicitMpm<Real>::move_block(std::size_t index, NodeTile& tile) {
  const PointBlock& block = store_.blocks()[index];
  const std::int32_t* stencil = grid_.stencil(grid_.slot_of(block.block));
  BlockReport report;
  store_.for_each(block, [&](std::uint32_t slot) {
    Point& p = store_.points[slot];
    std::int32_t& cell_key = store_.key[slot];
    const int local = cell_key & 63;
    Gathered g;
    Real moved[3];
    const bool near_wall = stencil[local] >= 0;
    if (near_wall)
      gather_near_wall(p, cell_key, stencil[local], tile, g, impulses_[index]);
    else
      gather(p, local, tile, g);
    if (has_void_) p.void_fraction = gather_void_fraction(p, local, tile);
    update(p, g, moved);

    Real move = 0, speed2 = 0;
    bool finite = true;
    for (int r = 0; r < 3; ++r) {
      finite = finite && std::isfinite(moved[r]);
      move = std::max(move, std::abs(moved[r]));
      speed2 += p.v[r] * p.v[r];
    }
    finite = finite && std::isfinite(speed2);
    if (!finite || move > Real(largest_move)) {
      if (!report.stopped) report = {.stopped = true, .finite = finite, .move = move, .culprit = slot};
      return;
    }
    if (speed2 > report.speed2) report.speed2 = speed2;
    if (g.bulk > Real(0.5) && g.fill > Real(full_for_anchor) && speed2 > report.bulk_speed2) {
      report.bulk_speed2 = speed2;
      report.fastest_bulk = slot;
    }

    for (int r = 0; r < 3; ++r) {
      p.before[r] = p.x[r];
      p.x[r] = quantised(p.x[r] + moved[r]);
    }
    if (near_wall) stop_at_walls(p, cell_key, stencil[local], impulses_[index]);
    settle_in_cell(p, cell_key);
    if (cell_key == BlockLayout::none) {
      report.left_grid = true;
      report.culprit = slot;
    }
  });
  report.mass = reports_[index].mass;
  reports_[index] = report;
}

/// Takes the point's nearest node as its cell.
template <class Real>
void ExplicitMpm<Real>::settle_in_cell(Point& p, std::int32_t& cell_key) const {
  Vec3i step = Vec3i::Zero();
  for (int r = 0; r < 3; ++r) {
    if (p.x[r] > Real(0.5)) step[r] = 1;
    if (p.x[r] < Real(-0.5)) step[r] = -1;
  }
  if (step.isZero()) return;
  for (int r = 0; r < 3; ++r) {
    p.x[r] -= static_cast<Real>(step[r]);
    p.before[r] -= static_cast<Real>(step[r]);
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
