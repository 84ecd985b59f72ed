#include "mpm/explicit_mpm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "base/errors.h"
#include "base/parallel.h"
#include "base/random.h"

namespace sluice {

namespace {
std::uint64_t bits_of(float x) {
  std::uint32_t b = 0;
  std::memcpy(&b, &x, sizeof b);
  return b;
}
std::uint64_t bits_of(double x) {
  std::uint64_t b = 0;
  std::memcpy(&b, &x, sizeof b);
  return b;
}
}  // namespace

template <class Real>
ExplicitMpm<Real>::ExplicitMpm(const MpmConfig& config, const Domain& domain, const Vec3& gravity,
                               const Walls& walls)
    : config_(config),
      domain_(domain),
      gravity_(gravity),
      walls_(walls),
      poses_(walls),
      limits_(step_limits(config, gravity, largest_viscosity(config.fluid, 0) / config.fluid.density,
                          poses_.fastest())),
      sound_speed_(limits_.sound_speed),
      layout_(domain, config.spacing),
      store_(layout_),
      grid_(layout_),
      yields_(config.fluid.rheology != Rheology::newtonian),
      largest_kinematic_viscosity_(largest_viscosity(config.fluid, 0) / config.fluid.density),
      loads_(walls.size()) {
  find_faces();
  bool stand = false;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const Wall& wall = walls.all()[w];
    stand = stand || (wall.blocks != BlocksPhase::rocks_only && !wall.mesh.triangles.empty() &&
                      poses_.body_of(static_cast<int>(w)) < 0);
  }
  if (stand)
    field_ = std::make_unique<WallField>(walls, poses_, domain, layout_.origin(), config.spacing,
                                         WhichWalls::standing);
}

template <class Real>
double ExplicitMpm<Real>::point_volume() const {
  return std::pow(config_.spacing / static_cast<double>(config_.points_per_cell_axis), 3);
}

template <class Real>
std::uint64_t ExplicitMpm<Real>::add(const NewPoint& point) {
  const FluidModel& fluid = config_.fluid;
  const double grains = point.fines_mass / fluid.fines_density;
  const double volume = grains + (point.mass - point.fines_mass) / fluid.density;
  const double phi = grains / volume;
  if (!(point.mass > 0) || !(phi >= 0) || !point.x.allFinite() || !point.v.allFinite() || !(point.J > 0))
    throw NumericalError("inflow", step_.t,
                         fmt::format("a new water point has mass {} kg, fines {} kg, J {}", point.mass,
                                     point.fines_mass, point.J),
                         "mass and J must be above 0, all else finite");
  if (phi >= 0.95 * fluid.packing)
    throw NumericalError(
        "inflow", step_.t,
        fmt::format("a new water point holds {:.3g} fines by volume (packing {})", phi, fluid.packing),
        "lower the fines, add water or raise 'packing'");
  const Vec3 cells = (domain_.wrapped(point.x) - layout_.origin()) / config_.spacing;
  const Vec3 nearest = cells.array().round();
  const std::int32_t cell_key = layout_.key(nearest.cast<int>());
  if (cell_key == BlockLayout::none)
    throw NumericalError("inflow", step_.t,
                         fmt::format("a new water point at ({:.4g}, {:.4g}, {:.4g}) m is outside the domain",
                                     point.x.x(), point.x.y(), point.x.z()),
                         "move the inflow inside or enlarge 'domain: box'");
  Point p{};
  for (int r = 0; r < 3; ++r) {
    p.x[r] = quantised(static_cast<Real>(cells[r] - nearest[r]));
    p.v[r] = static_cast<Real>(point.v[r]);
  }
  p.x[3] = static_cast<Real>(point.J - 1.0);
  p.v[3] = static_cast<Real>(point.mass);
  p.C[0][3] = static_cast<Real>(volume);
  const double viscosity = largest_viscosity(fluid, phi);  // it is not sheared yet
  p.C[1][3] = static_cast<Real>(viscosity);
  p.C[2][3] = 1;
  const double kinematic = viscosity * volume / point.mass;
  if (kinematic > largest_kinematic_viscosity_) {
    largest_kinematic_viscosity_ = kinematic;
    limits_ = step_limits(config_, gravity_, kinematic, poses_.fastest());
  }
  store_.add(p, cell_key, next_id_, point.mass, point.fines_mass);
  momentum_added_ += point.mass * velocity_of(p);
  kinetic_added_ += 0.5 * point.mass * velocity_of(p).squaredNorm();
  return next_id_++;
}

template <class Real>
WaterPoints ExplicitMpm<Real>::points() const {
  std::vector<std::uint32_t> order;
  order.reserve(count());
  for (std::size_t slot = 0; slot < store_.slots(); ++slot)
    if (store_.alive(slot)) order.push_back(static_cast<std::uint32_t>(slot));
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return store_.id[a] < store_.id[b]; });
  WaterPoints out;
  const std::size_t n = order.size();
  out.id.resize(n);
  out.x.resize(n);
  out.v.resize(n);
  out.mass.resize(n);
  out.fines_mass.resize(n);
  out.J.resize(n);
  out.pressure.resize(n);
  parallel_for(n, [&](std::size_t i) {
    const std::size_t slot = order[i];
    const Point& p = store_.points[slot];
    const double J = 1.0 + static_cast<double>(p.dilation());
    out.id[i] = store_.id[slot];
    out.x[i] = domain_.wrapped(position(p.x, store_.key[slot]));
    out.v[i] = velocity_of(p);
    out.mass[i] = store_.mass[slot];
    out.fines_mass[i] = fines_of(slot);
    out.J[i] = J;
    out.pressure[i] = pressure_of(store_.mass[slot] / static_cast<double>(p.volume()), sound_speed_, J);
  });
  return out;
}

template <class Real>
std::vector<RemovedPoint> ExplicitMpm<Real>::remove_if(
    const std::function<bool(const Vec3& before, const Vec3& now)>& leaves) {
  return remove_slots([&](std::size_t slot) {
    const std::int32_t key = store_.key[slot];
    return leaves(position(store_.before[slot], key), position(store_.points[slot].x, key));
  });
}

template <class Real>
std::vector<RemovedPoint> ExplicitMpm<Real>::remove_outside() {
  return remove_slots([&](std::size_t slot) {
    const std::int32_t key = store_.key[slot];
    return at_face_[static_cast<std::size_t>(key >> 6)] &&
           domain_.outside(position(store_.points[slot].x, key));
  });
}

template <class Real>
void ExplicitMpm<Real>::find_faces() {
  at_face_.resize(static_cast<std::size_t>(layout_.block_count()));
  for (std::int32_t block = 0; block < layout_.block_count(); ++block) {
    const Vec3i lowest = BlockLayout::edge * layout_.block_place(block);
    const Vec3 half = Vec3::Constant(0.5 * config_.spacing);
    at_face_[static_cast<std::size_t>(block)] =
        domain_.outside(layout_.node_position(lowest) - half) ||
        domain_.outside(layout_.node_position((lowest.array() + (BlockLayout::edge - 1)).matrix()) + half);
  }
}

/// Removes the slots for which leaves(slot) says so; called in parallel.
template <class Real>
template <class Leaves>
std::vector<RemovedPoint> ExplicitMpm<Real>::remove_slots(const Leaves& leaves) {
  constexpr std::size_t chunk = 2048;
  std::vector<std::vector<std::uint32_t>> found((store_.slots() + chunk - 1) / chunk);
  parallel_chunks(store_.slots(), chunk, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t slot = begin; slot < end; ++slot)
      if (store_.alive(slot) && leaves(slot)) found[c].push_back(static_cast<std::uint32_t>(slot));
  });
  std::vector<std::uint32_t> slots;
  for (const auto& list : found) slots.insert(slots.end(), list.begin(), list.end());
  std::sort(slots.begin(), slots.end(),
            [&](std::uint32_t a, std::uint32_t b) { return store_.id[a] < store_.id[b]; });
  std::vector<RemovedPoint> removed;
  removed.reserve(slots.size());
  for (const std::uint32_t slot : slots) {
    const Point& p = store_.points[slot];
    removed.push_back({store_.id[slot], position(p.x, store_.key[slot]), velocity_of(p), store_.mass[slot],
                       fines_of(slot)});
    momentum_removed_ += store_.mass[slot] * velocity_of(p);
    kinetic_removed_ += 0.5 * store_.mass[slot] * velocity_of(p).squaredNorm();
    store_.remove(slot);
  }
  return removed;
}

template <class Real>
Vec3 ExplicitMpm<Real>::momentum() const {
  return parallel_sum<Vec3>(
      store_.slots(),
      [&](std::size_t slot) -> Vec3 {
        if (!store_.alive(slot)) return Vec3::Zero();
        return store_.mass[slot] * velocity_of(store_.points[slot]);
      },
      Vec3::Zero());
}

template <class Real>
double ExplicitMpm<Real>::kinetic_energy() const {
  return parallel_sum<double>(store_.slots(), [&](std::size_t slot) {
    return store_.alive(slot) ? 0.5 * store_.mass[slot] * velocity_of(store_.points[slot]).squaredNorm()
                              : 0.0;
  });
}

template <class Real>
double ExplicitMpm<Real>::total_mass() const {
  return parallel_sum<double>(store_.slots(),
                              [&](std::size_t slot) { return store_.alive(slot) ? store_.mass[slot] : 0.0; });
}

template <class Real>
double ExplicitMpm<Real>::total_fines() const {
  return parallel_sum<double>(store_.slots(),
                              [&](std::size_t slot) { return store_.alive(slot) ? fines_of(slot) : 0.0; });
}

template <class Real>
std::uint64_t ExplicitMpm<Real>::state_hash() const {
  return parallel_sum<std::uint64_t>(store_.slots(), [&](std::size_t slot) -> std::uint64_t {
    if (!store_.alive(slot)) return 0;
    const Point& p = store_.points[slot];
    std::uint64_t hash = mix64(store_.id[slot]);
    hash = mix64(hash ^ static_cast<std::uint32_t>(store_.key[slot]));
    for (int r = 0; r < 3; ++r) hash = mix64(hash ^ bits_of(p.x[r]));
    for (int r = 0; r < 3; ++r) hash = mix64(hash ^ bits_of(p.v[r]));
    return mix64(hash ^ bits_of(p.dilation()));
  });
}

template <class Real>
std::size_t ExplicitMpm<Real>::memory_bytes() const {
  std::size_t blocks_of_colours = 0;
  for (const auto& colour : colours_) blocks_of_colours += colour.capacity();
  return store_.memory_bytes() + grid_.memory_bytes() + scatter_scratch_.capacity() * sizeof(ScatterScratch) +
         gather_scratch_.capacity() * sizeof(GatherScratch) + blocks_of_colours * sizeof(std::uint32_t) +
         node_begin_.capacity() * sizeof(std::uint32_t) + impulse_.capacity() * sizeof(Vec3) +
         impulses_.capacity() * sizeof(WallImpulses) + reports_.capacity() * sizeof(BlockReport) +
         at_face_.capacity() + (field_ ? field_->memory_bytes() : 0) +
         (moving_field_ ? moving_field_->memory_bytes() : 0);
}

template <class Real>
void ExplicitMpm<Real>::exchange(StateArchive& archive) {
  archive.enter("water");
  store_.exchange(archive);
  archive.value("next_id", next_id_);
  archive.value("largest_kinematic_viscosity", largest_kinematic_viscosity_);
  archive.value("largest_speed", largest_speed_);
  archive.value("gravity_impulse", gravity_impulse_);
  archive.value("momentum_added", momentum_added_);
  archive.value("momentum_removed", momentum_removed_);
  archive.value("kinetic_added", kinetic_added_);
  archive.value("kinetic_removed", kinetic_removed_);
  archive.value("wall_work", wall_work_);
  archive.value("time", step_.t);
  std::vector<std::array<double, 8>> loads;
  for (const WallLoad& load : loads_)
    loads.push_back({load.impulse.x(), load.impulse.y(), load.impulse.z(), load.angular_impulse.x(),
                     load.angular_impulse.y(), load.angular_impulse.z(), load.sliding_energy,
                     load.impact_energy});
  archive.values("wall_loads", loads);

  // Void fractions are held until set again: they belong to the state, with the blocks that hold them.
  archive.value("has_void_fraction", has_void_);
  std::vector<std::int32_t> active = grid_.active();
  archive.values("active_blocks", active);
  std::vector<std::array<Real, BlockLayout::nodes>> voids;
  if (!archive.loading() && has_void_) {
    voids.resize(active.size());
    for (std::size_t b = 0; b < active.size(); ++b)
      std::copy_n(grid_.void_fraction(grid_.slot_of(active[b])), BlockLayout::nodes, voids[b].begin());
  }
  archive.values("void_fraction", voids);
  archive.leave();
  if (!archive.loading()) return;

  if (loads.size() != loads_.size()) throw EnvironmentError("saved state: the number of walls has changed");
  for (std::size_t w = 0; w < loads.size(); ++w) {
    const auto& l = loads[w];
    loads_[w] = {Vec3(l[0], l[1], l[2]), Vec3(l[3], l[4], l[5]), l[6], l[7]};
  }
  limits_ = step_limits(config_, gravity_, largest_kinematic_viscosity_, poses_.fastest());
  grid_.restore(active, [&](std::int32_t slot) { prepare_block(slot); });
  grid_.forget_void_fractions();
  if (has_void_) grid_.hold_void_fractions();
  for (std::size_t b = 0; b < voids.size(); ++b)
    std::copy(voids[b].begin(), voids[b].end(), grid_.held_void_fraction(grid_.slot_of(active[b])));
  node_begin_.assign(1, 0);
}

template class ExplicitMpm<float>;
template class ExplicitMpm<double>;

}  // namespace sluice
