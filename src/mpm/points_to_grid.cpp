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
  share_step(dt);
  const double h = config_.spacing;
  const double g = gravity_.norm();
  // Time constants in the grid's acoustic time h/c, and of the anchor in the wave time of the depth: where
  // the scheme was measured, 0.1 s for 0.5 m of water.
  step_.t_velocity = 1.1 * h / sound_speed_;
  const double t_dilation = 1.5 * h / sound_speed_;
  const double t_anchor = config_.deepest > 0 && g > 0 ? 0.45 * std::sqrt(config_.deepest / g) : 0.1;
  step_.relax_velocity = static_cast<Real>(1.0 - std::exp(-dt / step_.t_velocity));
  step_.relax_dilation = static_cast<Real>(1.0 - std::exp(-dt / t_dilation));
  step_.anchor = static_cast<Real>(dt / t_anchor);
  step_.shift = static_cast<Real>(0.5 / t_anchor * dt);

  store_.bin();
  const bool moving = poses_.any() || moving_field_;
  grid_.activate(store_.blocks(), [&](std::int32_t slot) {
    if (!moving) prepare_block(slot);
  });
  if (moving) place_walls(t, dt);
  if (has_walls()) grid_.hold_strains();
  const std::size_t blocks = store_.blocks().size();
  colour_blocks();
  if (impulses_.size() < std::max(blocks, grid_.active().size()))
    impulses_.resize(std::max(blocks, grid_.active().size()));
  reports_.resize(blocks);
  const std::vector<std::int32_t>& active = grid_.active();
  parallel_for(
      active.size(),
      [&](std::size_t b) {
        const std::int32_t slot = grid_.slot_of(active[b]);
        Node* nodes = grid_.nodes(slot);
        for (int n = 0; n < BlockLayout::nodes; ++n) nodes[n].clear();
        std::fill_n(grid_.blend(slot), BlockLayout::nodes, Vector{});
        if (auto* strain = grid_.strain(slot)) std::fill_n(strain, BlockLayout::nodes, typename Node::Half{});
      },
      16);
  for (const std::vector<std::uint32_t>& colour : colours_)
    parallel_chunks_with(scatter_scratch_, colour.size(), 1,
                         [&](ScatterScratch& scratch, std::size_t, std::size_t n, std::size_t) {
                           scatter_block(colour[n], scratch);
                         });
  if (has_walls()) pour_loads(blocks);
  double mass = 0;
  for (const BlockReport& r : reports_) mass += r.mass;
  gravity_impulse_ += mass * dt * gravity_;

  node_begin_.assign(active.size() + 1, 0);
  parallel_for(
      active.size(),
      [&](std::size_t b) {
        const std::int32_t slot = grid_.slot_of(active[b]);
        node_begin_[b + 1] = finish_nodes(slot);
      },
      4);
  for (std::size_t b = 0; b < active.size(); ++b) node_begin_[b + 1] += node_begin_[b];
  impulse_.clear();
}

template <class Real>
void ExplicitMpm<Real>::share_step(double dt) {
  const double h = config_.spacing, c2 = sound_speed_ * sound_speed_;
  step_.dt = dt;
  step_.dt_real = static_cast<Real>(dt);
  step_.h = static_cast<Real>(h);
  step_.per_h = static_cast<Real>(4 / h);
  step_.c2 = static_cast<Real>(c2);
  step_.stress = static_cast<Real>(4 / h * dt);
  step_.cells_per_speed = static_cast<Real>(dt / h);
  step_.dilation_per_speed = static_cast<Real>(h / (dt * c2));
}

/// Walls that have moved are looked at anew where there is water.
template <class Real>
void ExplicitMpm<Real>::place_walls(double t, double dt) {
  const std::vector<std::int32_t>& active = grid_.active();
  std::array<Vec3i, 2> reach{Vec3i::Constant(1 << 28), Vec3i::Constant(-(1 << 28))};
  for (const std::int32_t block : active) {
    const Vec3i lowest = BlockLayout::edge * layout_.block_place(block);
    reach[0] = reach[0].cwiseMin(lowest);
    reach[1] = reach[1].cwiseMax((lowest.array() + (BlockLayout::edge - 1)).matrix());
  }
  const bool moved = poses_.place(t, dt);
  if (!poses_.any()) {
    moving_field_.reset();
  } else if (moved || !moving_field_ || (reach[0].array() < looked_at_[0].array()).any() ||
             (reach[1].array() > looked_at_[1].array()).any()) {
    moving_field_ = std::make_unique<WallField>(walls_, poses_, domain_, layout_.origin(), config_.spacing,
                                                WhichWalls::near_moving, reach);
    looked_at_ = reach;
  }
  parallel_for(
      active.size(), [&](std::size_t b) { prepare_block(grid_.slot_of(active[b])); }, 16);
}

template <class Real>
void ExplicitMpm<Real>::set_bodies(std::span<const FluidBody> bodies) {
  poses_.set_bodies(bodies, domain_, 4 * config_.spacing);
  body_loads_.assign(bodies.size(), {});
}

template <class Real>
void ExplicitMpm<Real>::prepare_block(std::int32_t slot) {
  const Vec3i place = layout_.block_place(grid_.block_of(slot));
  const Vec3i width = layout_.width(place);
  bool at_wall = false;
  for (int k = 0; k < width.z(); ++k)
    for (int j = 0; j < width.y(); ++j)
      for (int i = 0; i < width.x(); ++i) {
        const Vec3i node = BlockLayout::edge * place + Vec3i(i, j, k);
        std::int32_t& stencil = grid_.stencil(slot)[i + 4 * j + 16 * k];
        stencil = moving_field_ ? moving_field_->stencil(node - Vec3i::Ones()) : -1;
        if (stencil >= 0)
          stencil += first_moving;
        else if (field_)
          stencil = field_->stencil(node - Vec3i::Ones());
        at_wall = at_wall || stencil >= 0;
      }
  if (at_wall) grid_.want_strain(slot);
}

template <class Real>
void ExplicitMpm<Real>::pour_loads(std::size_t lists) {
  for (std::size_t b = 0; b < lists; ++b) {
    impulses_[b].for_each([&](int wall, const WallLoad& load) {
      const int body = poses_.free_body(wall);
      if (body < 0) {
        loads_[static_cast<std::size_t>(wall)] += load;
        wall_work_ -= poses_.work(wall, load.impulse, load.angular_impulse);
        return;
      }
      BodyLoad& on_body = body_loads_[static_cast<std::size_t>(body)];
      on_body.impulse += load.impulse;
      on_body.angular_impulse += load.angular_impulse - poses_.centre(wall).cross(load.impulse);
    });
    impulses_[b].clear();
  }
}

/// At a node whose distance is d cells, a point gives w times its momentum m (v + C h d), its stress, and so
/// on.
template <class Real>
void ExplicitMpm<Real>::contribute(const Point& p, const Vector& misfit, Contribution& a) const {
  const Real m = p.mass(), e = p.dilation(), per_void = has_void_ ? 1 / p.void_fraction() : Real(1);
  const Real now = p.volume() * (1 + e), volume = now * per_void;
  const Vector C[3] = {with_fourth(p.C[0], Real(0)), with_fourth(p.C[1], Real(0)),
                       with_fourth(p.C[2], Real(0))};
  const Real drag = step_.stress * volume * p.viscosity();
  // V p = -m c2 (J - 1): the volume cancels in p = (m / V0) c2 (1/J - 1).
  const Real push =
      -step_.stress * m * step_.c2 * e * per_void + drag * (C[0][0] + C[1][1] + C[2][2]) * Real(2.0 / 3.0);

  Vector momentum = m * p.v, impulse{};
  for (int c = 0; c < 3; ++c) {
    const Vector row = {C[0][c], C[1][c], C[2][c], 0};
    Vector unit{};
    unit[c] = 1;
    const Vector spin = m * step_.h * C[c], stress = push * unit - drag * (C[c] + row);
    momentum -= p.x[c] * spin;
    impulse -= p.x[c] * stress;
    a.slope[c].quad(0) = spin;
    a.slope[c].quad(1) = stress;
    a.slope[c].quad(2) = -m * unit;
    a.slope[c].quad(3) = step_.per_h * volume * unit;
  }
  a.middle.quad(0) = with_fourth(momentum, m);
  a.middle.quad(1) = with_fourth(impulse, now);
  a.middle.quad(2) = m * p.x;
  a.middle.quad(3) = with_fourth(-step_.per_h * volume * p.x, Real(0));

  a.shared = m * with_fourth(misfit, rate_of_shear(p));

  const SplineWeights<Real> x(p.x[0]), y(p.x[1]), z(p.x[2]);
  const Vector along = {x.w[0], x.w[1], x.w[2], 0};
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) a.weight[j + 3 * k] = y.w[j] * z.w[k] * along;
}

template <class Real>
void ExplicitMpm<Real>::scatter_block(std::size_t index, ScatterScratch& scratch) {
  const PointBlock& block = store_.blocks()[index];
  Node* tile = scratch.tile;
  for (int n = 0; n < BlockLayout::tile_nodes; ++n) tile[n].clear();
  std::fill_n(scratch.blend, BlockLayout::tile_nodes, Vector{});
  bool strained = false;
  const std::int32_t* stencil = grid_.stencil(grid_.slot_of(block.block));
  double mass = 0;
  for (int local = 0; local < BlockLayout::nodes; ++local) {
    Node* corner = tile + (local & 3) + 6 * ((local >> 2) & 3) + 36 * (local >> 4);
    for (std::span<const std::uint32_t> slots = store_.of_cell(index, local); !slots.empty();) {
      const std::size_t count = std::min<std::size_t>(slots.size(), ScatterScratch::batch);
      for (std::size_t n = 0; n < count; ++n) {
        const Point& p = store_.points[slots[n]];
        mass += static_cast<double>(p.mass());
        contribute(p, store_.misfit[slots[n]].quad(), scratch.point[n]);
        if (stencil[local] < 0) continue;
        const bool beyond_edge =
            hide_nodes(p, store_.key[slots[n]], stencil[local], scratch.point[n], impulses_[index]);
        if (!beyond_edge && scratch.point[n].middle[node_lane::near_wall] == 0) continue;
        if (!strained) std::fill_n(scratch.strain, BlockLayout::tile_nodes, typename Node::Half{});
        strained = true;
        scatter_strain(p, scratch.point[n], beyond_edge, scratch.strain + (corner - tile));
      }
      scatter({scratch.point, count}, corner);
      scatter_shared({scratch.point, count}, scratch.blend + (corner - tile));
      slots = slots.subspan(count);
    }
  }
  reports_[index].mass = mass;
  add_tile(block, tile, scratch.blend);
  if (strained) add_strain(block, scratch.strain);
}

template <class Real>
void ExplicitMpm<Real>::scatter_strain(const Point& p, const Contribution& a, bool beyond_edge,
                                       typename Node::Half* corner) const {
  const Real m = p.mass(), half = m / 2;
  typename Node::Half strain = {m * p.C[0][0],
                                m * p.C[1][1],
                                m * p.C[2][2],
                                half * (p.C[1][2] + p.C[2][1]),
                                half * (p.C[0][2] + p.C[2][0]),
                                half * (p.C[0][1] + p.C[1][0]),
                                0,
                                0};
  if (beyond_edge) {
    strain = typename Node::Half{};
    strain[6] = m;
  }
  for (int n = 0; n < 27; ++n)
    corner[n % 3 + 6 * (n / 3 % 3) + 36 * (n / 9)] += a.weight[n / 3][n % 3] * strain;
}

/// Adds points of one cell: nodes stay in registers, nine at a time, while the points pass.
template <class Real>
void ExplicitMpm<Real>::scatter(std::span<const Contribution> points, Node* corner) const {
  for (int r = 0; r < Node::registers; ++r)
    for (int k = 0; k < 3; ++k) {
      typename Node::Register sum[9];
      for (int n = 0; n < 9; ++n) sum[n] = corner[n % 3 + 6 * (n / 3) + 36 * k].part[r];
      const Real layer = static_cast<Real>(k - 1);
      for (const Contribution& a : points) {
        const auto ax = a.slope[0].part[r], ay = a.slope[1].part[r];
        const auto row1 = a.middle.part[r] + layer * a.slope[2].part[r];
        const auto row0 = row1 - ay, row2 = row1 + ay;
        const Real* w = reinterpret_cast<const Real*>(a.weight + 3 * k);
        sum[0] += w[0] * (row0 - ax);
        sum[1] += w[1] * row0;
        sum[2] += w[2] * (row0 + ax);
        sum[3] += w[4] * (row1 - ax);
        sum[4] += w[5] * row1;
        sum[5] += w[6] * (row1 + ax);
        sum[6] += w[8] * (row2 - ax);
        sum[7] += w[9] * row2;
        sum[8] += w[10] * (row2 + ax);
      }
      for (int n = 0; n < 9; ++n) corner[n % 3 + 6 * (n / 3) + 36 * k].part[r] = sum[n];
    }
}

/// The same for what has no slope.
template <class Real>
void ExplicitMpm<Real>::scatter_shared(std::span<const Contribution> points, Vector* corner) const {
  for (int k = 0; k < 3; ++k) {
    Vector sum[9];
    for (int n = 0; n < 9; ++n) sum[n] = corner[n % 3 + 6 * (n / 3) + 36 * k];
    for (const Contribution& a : points) {
      const Real* w = reinterpret_cast<const Real*>(a.weight + 3 * k);
      for (int n = 0; n < 9; ++n) sum[n] += w[n % 3 + 4 * (n / 3)] * a.shared;
    }
    for (int n = 0; n < 9; ++n) corner[n % 3 + 6 * (n / 3) + 36 * k] = sum[n];
  }
}

template <class Real>
void ExplicitMpm<Real>::add_tile(const PointBlock& block, const Node* tile, const Vector* blend) {
  visit_tile(block, [&](std::int32_t slot, int to, int from, int length) {
    Node* nodes = grid_.nodes(slot);
    Vector* blends = grid_.blend(slot);
    for (int n = 0; n < length; ++n) {
      nodes[to + n].add(tile[from + n]);
      blends[to + n] += blend[from + n];
    }
  });
}

template <class Real>
void ExplicitMpm<Real>::add_strain(const PointBlock& block, const typename Node::Half* strain) {
  visit_tile(block, [&](std::int32_t slot, int to, int from, int length) {
    auto* nodes = grid_.strain(slot);
    for (int n = 0; nodes && n < length; ++n) nodes[to + n] += strain[from + n];
  });
}

/// Blocks of one colour write to no common node: along each axis they are two apart, also through a periodic
/// face, and where the last block is but one node wide, those on both sides of it differ, too.
template <class Real>
int ExplicitMpm<Real>::colour_of(const Vec3i& place) const {
  int colour = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int blocks = layout_.blocks()[axis], last = blocks - 1;
    int own = place[axis] & 1;
    if (domain_.periodic(axis)) {
      if (place[axis] == last && last % 2 == 0) own = 2;
      if (place[axis] == last - 1 && layout_.width(axis, last) == 1) own = 3;
    }
    colour = 4 * colour + own;
  }
  return colour;
}

template <class Real>
void ExplicitMpm<Real>::colour_blocks() {
  colours_.resize(64);
  for (std::vector<std::uint32_t>& colour : colours_) colour.clear();
  const std::vector<PointBlock>& blocks = store_.blocks();
  for (std::size_t b = 0; b < blocks.size(); ++b)
    colours_[static_cast<std::size_t>(colour_of(layout_.block_place(blocks[b].block)))].push_back(
        static_cast<std::uint32_t>(b));
}

/// Turns a block's sums into velocities and means; returns how many of its nodes carry mass.
template <class Real>
std::uint32_t ExplicitMpm<Real>::finish_nodes(std::int32_t slot) {
  using namespace node_lane;
  Node* nodes = grid_.nodes(slot);
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
    grid_.blend(slot)[n] *= per_mass;
    node[fill] *= per_cell / (open_fraction(slot, n) * void_fraction[n]);
  }
  return with_mass;
}

template void ExplicitMpm<float>::points_to_grid(double, double);
template void ExplicitMpm<float>::share_step(double);
template void ExplicitMpm<float>::prepare_block(std::int32_t);
template void ExplicitMpm<float>::place_walls(double, double);
template void ExplicitMpm<float>::pour_loads(std::size_t);
template void ExplicitMpm<float>::set_bodies(std::span<const FluidBody>);
template void ExplicitMpm<double>::points_to_grid(double, double);
template void ExplicitMpm<double>::share_step(double);
template void ExplicitMpm<double>::prepare_block(std::int32_t);
template void ExplicitMpm<double>::place_walls(double, double);
template void ExplicitMpm<double>::pour_loads(std::size_t);
template void ExplicitMpm<double>::set_bodies(std::span<const FluidBody>);

}  // namespace sluice
