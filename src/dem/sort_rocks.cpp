/// Rocks that are near each other in space, near each other in memory: sorted along a Morton curve through
/// cells as wide as the smallest rock. The order depends on places and ids only.

#include <algorithm>
#include <numeric>

#include "dem/dem_state.h"

namespace sluice {

namespace {

/// Spreads the low 21 bits three apart.
std::uint64_t spread(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffffULL;
  v = (v | v << 16) & 0x1f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  return (v | v << 2) & 0x1249249249249249ULL;
}

std::uint64_t place_on_curve(const Vec3& x, const Vec3& low, double width) {
  std::uint64_t code = 0;
  for (int k = 0; k < 3; ++k) {
    const double cell = std::clamp((x[k] - low[k]) / width, 0.0, 2097151.0);
    code |= spread(static_cast<std::uint64_t>(cell)) << k;
  }
  return code;
}

template <class T>
void permute(std::vector<T>& v, const std::vector<std::uint32_t>& order) {
  if (v.empty()) return;
  std::vector<T> sorted;
  sorted.reserve(v.size());
  for (const std::uint32_t from : order) sorted.push_back(std::move(v[from]));
  v.swap(sorted);
}

}  // namespace

void DemSystem::Implementation::sort_in_space() {
  const std::size_t n = count();
  std::vector<std::uint64_t> code(n);
  for (std::size_t i = 0; i < n; ++i)
    code[i] = place_on_curve(rocks.x[i], scene.domain.box.lo, scene.smallest_size);
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return code[a] != code[b] ? code[a] < code[b] : rocks.id[a] < rocks.id[b];
  });
  if (std::is_sorted(order.begin(), order.end())) return;
  std::vector<int> new_index(n);
  for (std::size_t k = 0; k < n; ++k) new_index[order[k]] = static_cast<int>(k);
  pairs.reorder(new_index);

  permute(rocks.id, order);
  permute(rocks.x, order);
  permute(rocks.v, order);
  permute(rocks.w, order);
  permute(rocks.q, order);
  permute(rocks.shape, order);
  permute(rocks.material, order);
  permute(rocks.source, order);
  permute(rocks.size, order);
  permute(rocks.mass, order);
  permute(rocks.radius, order);
  permute(rocks.birth, order);
  permute(rocks.wet_dose, order);
  permute(rocks.wetted, order);
  permute(angular, order);
  permute(per_inertia, order);
  permute(push, order);
  permute(fluid_force, order);
  permute(fluid_torque, order);
  permute(near_walls, order);
  for (MovingWalls& part : moving) permute(part.near, order);
  permute(places, order);
  permute(motions, order);
  permute(turned_shapes, order);
  permute(rim_speed, order);
}

}  // namespace sluice
