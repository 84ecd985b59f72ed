#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "mpm/explicit_mpm.h"

namespace sluice {

namespace {
/// Rocks never leave less than this of a node to the water (their volumes overlap on coarse kernels).
constexpr double least_void_fraction = 0.05;

template <class Real>
Vec3 vector_at(const Lanes<Real>& node, int lane) {
  return {static_cast<double>(node[lane]), static_cast<double>(node[lane + 1]),
          static_cast<double>(node[lane + 2])};
}
}  // namespace

template <class Real>
void ExplicitMpm<Real>::read_nodes(FluidNodes& out) const {
  using namespace node_lane;
  const std::vector<std::int32_t>& active = grid_.active();
  const std::size_t count = node_begin_.back();
  out.spacing = config_.spacing;
  out.x.resize(count);
  out.mass.resize(count);
  out.v.resize(count);
  out.open_volume.resize(count);
  out.pressure.resize(count);
  out.fill.resize(count);
  out.viscosity.resize(count);
  out.density.resize(count);
  const FluidModel& fluid = config_.fluid;
  const double cell = std::pow(config_.spacing, 3);
  parallel_for(
      active.size(),
      [&](std::size_t b) {
        const std::int32_t slot = grid_.slot_of(active[b]);
        const Vec3i place = BlockLayout::edge * layout_.block_place(active[b]);
        const Node* nodes = grid_.nodes(slot);
        std::size_t to = node_begin_[b];
        for (int n = 0; n < BlockLayout::nodes; ++n) {
          const Node& node = nodes[n];
          if (node[mass] == 0) continue;
          const double m = static_cast<double>(node[mass]);
          const double volume =
              static_cast<double>(node[fill] * open_fraction(slot, n) * grid_.void_fraction(slot)[n]) * cell;
          const double density = volume > 0 ? m / volume : fluid.density;
          const double e = static_cast<double>(node[dilation]);
          out.x[to] = layout_.node_position(place + Vec3i(n & 3, (n >> 2) & 3, n >> 4));
          out.mass[to] = m;
          out.v[to] = vector_at(node, velocity) + vector_at(node, change);
          out.open_volume[to] = static_cast<double>(open_fraction(slot, n)) * cell;
          out.pressure[to] = -density * sound_speed_ * sound_speed_ * e / (1 + e);
          out.fill[to] = static_cast<double>(node[fill]);
          out.viscosity[to] = viscosity_of(density * (1 + e), 0);
          out.density[to] = density;
          ++to;
        }
      },
      4);
}

template <class Real>
void ExplicitMpm<Real>::add_impulse(std::span<const Vec3> impulse) {
  if (impulse_.empty())
    impulse_.assign(impulse.begin(), impulse.end());
  else
    for (std::size_t n = 0; n < impulse.size(); ++n) impulse_[n] += impulse[n];
}

template <class Real>
void ExplicitMpm<Real>::set_void_fraction(std::span<const double> void_fraction) {
  has_void_ = true;
  grid_.hold_void_fractions();
  const std::vector<std::int32_t>& active = grid_.active();
  parallel_for(
      active.size(),
      [&](std::size_t b) {
        const std::int32_t slot = grid_.slot_of(active[b]);
        Node* nodes = grid_.nodes(slot);
        Real* held = grid_.held_void_fraction(slot);
        std::size_t from = node_begin_[b];
        for (int n = 0; n < BlockLayout::nodes; ++n) {
          if (nodes[n][node_lane::mass] == 0) continue;
          const Real now = static_cast<Real>(std::clamp(void_fraction[from++], least_void_fraction, 1.0));
          nodes[n][node_lane::fill] *= held[n] / now;
          held[n] = now;
        }
      },
      4);
}

template <class Real>
void ExplicitMpm<Real>::read_accelerations(std::vector<Vec3>& acceleration) const {
  const std::vector<std::int32_t>& active = grid_.active();
  acceleration.resize(node_begin_.back());
  parallel_for(
      active.size(),
      [&](std::size_t b) {
        const Node* nodes = grid_.nodes(grid_.slot_of(active[b]));
        std::size_t to = node_begin_[b];
        for (int n = 0; n < BlockLayout::nodes; ++n)
          if (nodes[n][node_lane::fill] != 0)  // as that of all that carry mass
            acceleration[to++] = vector_at(nodes[n], node_lane::change) / step_.dt;
      },
      4);
}

template void ExplicitMpm<float>::read_nodes(FluidNodes&) const;
template void ExplicitMpm<float>::read_accelerations(std::vector<Vec3>&) const;
template void ExplicitMpm<float>::add_impulse(std::span<const Vec3>);
template void ExplicitMpm<float>::set_void_fraction(std::span<const double>);
template void ExplicitMpm<double>::read_nodes(FluidNodes&) const;
template void ExplicitMpm<double>::read_accelerations(std::vector<Vec3>&) const;
template void ExplicitMpm<double>::add_impulse(std::span<const Vec3>);
template void ExplicitMpm<double>::set_void_fraction(std::span<const double>);

}  // namespace sluice
