#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "mpm/explicit_mpm.h"
#include "mpm/spline_weights.h"

namespace sluice {

namespace {
/// Below this mass [kg] a node carries nothing: float sums of weights near 0 would be denormal.
constexpr double least_node_mass = 1e-30;
}  // namespace

template <class Real>
void ExplicitMpm<Real>::points_to_grid(double t, double dt) {
  step_.t = t;
  step_.dt = dt;
  const double h = config_.spacing;
  const double g = gravity_.norm();
  // Time constants in the grid's acoustic time h/c, and of the anchor in the wave time of the depth: where
  // the scheme was measured, 0.1 s for 0.5 m of water.
  const double t_velocity = 1.1 * h / sound_speed_;
  const double t_dilation = 1.5 * h / sound_speed_;
  const double t_anchor = config_.deepest > 0 && g > 0 ? 0.45 * std::sqrt(config_.deepest / g) : 0.1;
  step_.relax_velocity = static_cast<Real>(1.0 - std::exp(-dt / t_velocity));
  step_.relax_dilation = static_cast<Real>(1.0 - std::exp(-dt / t_dilation));
  step_.anchor = static_cast<Real>(dt / t_anchor);
  step_.shift = static_cast<Real>(0.5 / t_anchor * dt);

  store_.bin();
  grid_.activate(store_.blocks(), [&](std::int32_t slot) { prepare_block(slot); });
  const std::size_t blocks = store_.blocks().size();
  tiles_.resize(blocks * BlockLayout::tile_nodes);
  if (impulses_.size() < std::max(blocks, grid_.active().size()))
    impulses_.resize(std::max(blocks, grid_.active().size()));
  reports_.resize(blocks);
  parallel_for(
      blocks, [&](std::size_t b) { scatter_block(b); }, 1);
  if (field_) pour_loads(blocks);
  double mass = 0;
  for (const BlockReport& r : reports_) mass += r.mass;
  gravity_impulse_ += mass * dt * gravity_;

  const std::vector<std::int32_t>& active = grid_.active();
  node_begin_.assign(active.size() + 1, 0);
  parallel_for(
      active.size(),
      [&](std::size_t b) {
        const std::int32_t slot = grid_.slot_of(active[b]);
        add_up_tiles(slot);
        node_begin_[b + 1] = finish_nodes(slot);
      },
      4);
  for (std::size_t b = 0; b < active.size(); ++b) node_begin_[b + 1] += node_begin_[b];
  impulse_.clear();
}

template <class Real>
void ExplicitMpm<Real>::prepare_block(std::int32_t slot) {
  if (!field_) return;
  const Vec3i place = layout_.block_place(grid_.block_of(slot));
  const Vec3i width = layout_.width(place);
  for (int k = 0; k < width.z(); ++k)
    for (int j = 0; j < width.y(); ++j)
      for (int i = 0; i < width.x(); ++i) {
        const Vec3i node = BlockLayout::edge * place + Vec3i(i, j, k);
        const int n = i + 4 * j + 16 * k;
        grid_.stencil(slot)[n] = field_->stencil(node - Vec3i::Ones());
        grid_.open(slot)[n] = static_cast<Real>(field_->open_fraction(node));
      }
}

template <class Real>
void ExplicitMpm<Real>::pour_loads(std::size_t lists) {
  for (std::size_t b = 0; b < lists; ++b) {
    impulses_[b].pour_into(loads_);
    impulses_[b].clear();
  }
}

/// Writes the lanes of a point's contribution: w (constant + sum slope_c d_c), d in cells.
template <class Real>
void ExplicitMpm<Real>::contribution(const Point& p, Node (&a)[4]) const {
  for (Node& lanes : a) lanes.clear();
  const Real h = static_cast<Real>(config_.spacing);
  const Real strength = static_cast<Real>(4.0 / config_.spacing * step_.dt);
  const Real volume = p.volume * (1 + p.dilation) / p.void_fraction;
  const Real c2 = static_cast<Real>(sound_speed_ * sound_speed_);
  // V p = -m c2 (J - 1): the volume cancels in p = (m / V0) c2 (1/J - 1).
  const Real push = -strength * p.mass * c2 * p.dilation / p.void_fraction;
  const Real drag = strength * volume * p.viscosity;
  const Real third = (p.C[0] + p.C[4] + p.C[8]) * Real(2.0 / 3.0);
  for (int r = 0; r < 3; ++r) {
    a[0][node_lane::velocity + r] = p.mass * p.v[r];
    for (int c = 0; c < 3; ++c) {
      a[1 + c][node_lane::velocity + r] = p.mass * h * p.C[3 * r + c];
      a[1 + c][node_lane::change + r] = -drag * (p.C[3 * r + c] + p.C[3 * c + r]);
    }
    a[1 + r][node_lane::change + r] += push + drag * third;
    a[1 + r][node_lane::centre + r] = -p.mass;
    a[1 + r][node_lane::gradient + r] = static_cast<Real>(4.0 / config_.spacing) * volume;
  }
  a[0][node_lane::mass] = p.mass;
  a[0][node_lane::fill] = p.volume * (1 + p.dilation);
  a[0][node_lane::dilation] = p.mass * p.dilation;
}

template <class Real>
void ExplicitMpm<Real>::scatter_block(std::size_t index) {
  const PointBlock& block = store_.blocks()[index];
  Node* tile = &tiles_[index * BlockLayout::tile_nodes];
  for (int n = 0; n < BlockLayout::tile_nodes; ++n) tile[n].clear();
  const std::int32_t* stencil = grid_.stencil(grid_.slot_of(block.block));
  double mass = 0;
  store_.for_each(block, [&](std::uint32_t slot) {
    const Point& p = store_.points[slot];
    const int local = store_.key[slot] & 63;
    mass += static_cast<double>(p.mass);
    Node a[4];
    contribution(p, a);
    if (stencil[local] >= 0) {
      scatter_near_wall(p, store_.key[slot], stencil[local], a, tile, impulses_[index]);
      return;
    }
    Node* corner = tile + (local & 3) + 6 * ((local >> 2) & 3) + 36 * (local >> 4);
    const SplineWeights<Real> x(p.x[0]), y(p.x[1]), z(p.x[2]);
    Node along[3];
    for (int i = 0; i < 3; ++i) along[i].set_sum(a[0], x.d[i], a[1]);
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j) {
        Node cross;
        const Real w = y.w[j] * z.w[k];
        for (int r = 0; r < Node::registers; ++r)
          cross.part[r] = y.d[j] * a[2].part[r] + z.d[k] * a[3].part[r];
        Node* row = corner + 6 * j + 36 * k;
        for (int i = 0; i < 3; ++i) {
          const Real wi = w * x.w[i];
          for (int r = 0; r < Node::registers; ++r) row[i].part[r] += wi * (along[i].part[r] + cross.part[r]);
        }
      }
  });
  reports_[index].mass = mass;
}

/// Sums the tiles that reach a node block, neighbour by neighbour in a fixed order.
template <class Real>
void ExplicitMpm<Real>::add_up_tiles(std::int32_t slot) {
  Node* nodes = grid_.nodes(slot);
  for (int n = 0; n < BlockLayout::nodes; ++n) nodes[n].clear();
  const Vec3i place = layout_.block_place(grid_.block_of(slot));
  const Vec3i width = layout_.width(place);
  for (int bit = 0; bit < 27; ++bit) {
    const int step[3] = {bit % 3 - 1, bit / 3 % 3 - 1, bit / 9 - 1};
    const std::int32_t from = layout_.neighbour(place, step[0], step[1], step[2]);
    if (from == BlockLayout::none) continue;
    const std::int32_t index = store_.index_of_block(from);
    if (index == BlockLayout::none) continue;
    // The neighbour reaches this block where its own mask has the opposite direction.
    if (!(store_.blocks()[static_cast<std::size_t>(index)].reach >> (26 - bit) & 1)) continue;
    const Node* tile = &tiles_[static_cast<std::size_t>(index) * BlockLayout::tile_nodes];
    const Vec3i from_width = layout_.width(layout_.block_place(from));
    int lo[3], hi[3], shift[3];
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = step[axis] > 0 ? width[axis] - 1 : 0;
      hi[axis] = step[axis] < 0 ? 1 : width[axis];
      shift[axis] = step[axis] < 0 ? from_width[axis] + 1 : step[axis] > 0 ? -lo[axis] : 1;
    }
    for (int k = lo[2]; k < hi[2]; ++k)
      for (int j = lo[1]; j < hi[1]; ++j)
        for (int i = lo[0]; i < hi[0]; ++i)
          nodes[i + 4 * j + 16 * k].add(tile[i + shift[0] + 6 * (j + shift[1]) + 36 * (k + shift[2])]);
  }
}

/// Turns a block's sums into velocities and means; returns how many of its nodes carry mass.
template <class Real>
std::uint32_t ExplicitMpm<Real>::finish_nodes(std::int32_t slot) {
  using namespace node_lane;
  Node* nodes = grid_.nodes(slot);
  const Real* open = grid_.open(slot);
  const Real* void_fraction = grid_.void_fraction(slot);
  const Real per_cell = static_cast<Real>(std::pow(config_.spacing, -3));
  std::uint32_t with_mass = 0;
  for (int n = 0; n < BlockLayout::nodes; ++n) {
    Node& node = nodes[n];
    if (!(node[mass] > Real(least_node_mass))) {
      node.clear();
      continue;
    }
    ++with_mass;
    const Real per_mass = 1 / node[mass];
    for (int r = 0; r < 3; ++r) {
      node[velocity + r] *= per_mass;
      node[change + r] = node[change + r] * per_mass + static_cast<Real>(step_.dt * gravity_[r]);
      node[centre + r] *= per_mass;
    }
    node[dilation] *= per_mass;
    node[fill] *= per_cell / (open[n] * void_fraction[n]);
  }
  return with_mass;
}

template void ExplicitMpm<float>::points_to_grid(double, double);
template void ExplicitMpm<float>::prepare_block(std::int32_t);
template void ExplicitMpm<float>::pour_loads(std::size_t);
template void ExplicitMpm<double>::points_to_grid(double, double);
template void ExplicitMpm<double>::prepare_block(std::int32_t);
template void ExplicitMpm<double>::pour_loads(std::size_t);

}  // namespace sluice
