#include "simulation/watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.h"

namespace sluice {

namespace {

constexpr int rock_steps_per_look = 100, water_steps_per_look = 20;

/// A belt's work on the water is not kept; that of a wall in motion is.
bool drags_water(const Wall& wall) {
  return wall.blocks != BlocksPhase::rocks_only && !wall.surface_velocity.isZero();
}

std::uint64_t scene_steps(int particle_steps, int substeps) {
  return static_cast<std::uint64_t>((particle_steps + substeps - 1) / substeps);
}

/// All energy that ever passed through the rocks [J].
double turnover(const DemEnergy& e) {
  return e.kinetic + std::abs(e.elastic) + e.dissipated_normal + e.dissipated_friction + e.removed;
}

std::size_t most_energetic(const Rocks& rocks) {
  std::size_t most = 0;
  for (std::size_t i = 1; i < rocks.count(); ++i)
    if (rocks.mass[i] * rocks.v[i].squaredNorm() > rocks.mass[most] * rocks.v[most].squaredNorm()) most = i;
  return most;
}

}  // namespace

Watch::Watch(const Parts& parts, const TimeStep& step) : parts_(parts), step_(step) {
  const auto& walls = parts.walls->all();
  if (parts.water) water_step_ = parts.water->limits().step;
  if (parts.rocks) rock_interval_ = scene_steps(rock_steps_per_look, step.rock_substeps);
  if (parts.water && std::none_of(walls.begin(), walls.end(), drags_water)) {
    water_interval_ = scene_steps(water_steps_per_look, step.fluid_substeps);
    momentum_ = parts.water->momentum();
  }
}

void Watch::look(double t, std::uint64_t steps) {
  if (parts_.water) look_at_step(t);
  if (rock_interval_ > 0 && steps % rock_interval_ == 0) look_at_rocks(t);
  if (water_interval_ > 0 && steps % water_interval_ == 0) look_at_water(t);
}

double Watch::created_by_rocks() const {
  if (!parts_.rocks) return 0;
  const DemEnergy energy = parts_.rocks->energy();
  const double all = turnover(energy);
  return all > 0 ? energy.created() / all : 0;
}

void Watch::look_at_rocks(double t) const {
  const DemEnergy energy = parts_.rocks->energy();
  const double created = energy.created(), all = turnover(energy);
  if (created <= most_created * all) return;
  const Rocks& rocks = parts_.rocks->rocks();
  double fall = 0;  // through their own size
  for (std::size_t i = 0; i < rocks.count(); ++i) fall += rocks.mass[i] * rocks.size[i];
  if (created <= least_created * fall * parts_.gravity.norm() || rocks.count() == 0) return;
  const std::size_t i = most_energetic(rocks);
  throw NumericalError(
      "rocks.substeps", t,
      fmt::format("rocks have {:.3g} J that nothing gave them, {:.3g} % of all (limit {:.0f} %); rock {} has "
                  "the most, {:.3g} m/s at {:.3g} m size",
                  created, 100 * created / all, 100 * most_created, rocks.id[i], rocks.v[i].norm(),
                  rocks.size[i]),
      "raise 'steps_per_contact' or lower 'network_fraction'");
}

void Watch::look_at_step(double t) const {
  const FluidStepLimits& limits = parts_.water->limits();
  if (limits.step >= std::min(water_step_, step_.dt_fluid()) * (1 - 1e-9)) return;
  throw NumericalError(
      "inflow", t,
      fmt::format(
          "water that has come in is so thick that its steps may have {:.3g} s ({}); the run has {:.3g} s",
          limits.step, limits.governed_by, step_.dt_fluid()),
      fmt::format("lower 'courant' by a factor of {:.3g}, the fines, or 'viscosity'{}",
                  step_.dt_fluid() / limits.step,
                  parts_.water->model().rheology == Rheology::newtonian ? "" : ", or raise 'yield_rate'"));
}

void Watch::look_at_water(double t) {
  const FluidSystem& water = *parts_.water;
  const Vec3 momentum = water.momentum();
  water_gravity_work_ += 0.5 * (t - looked_at_) * parts_.gravity.dot(momentum_ + momentum);
  momentum_ = momentum;
  looked_at_ = t;

  const double from_rocks = parts_.rocks ? std::max(0.0, -parts_.rocks->energy().fluid_work) : 0;
  const double from_walls = water.wall_work();
  const double given =
      water.kinetic_added() - water.kinetic_removed() + water_gravity_work_ + from_rocks + from_walls;
  const double created = water.kinetic_energy() - given;
  const double expected_speed = 0.1 * water.limits().sound_speed;
  const double all =
      water.kinetic_added() + std::max(0.0, water_gravity_work_) + from_rocks + std::max(0.0, from_walls);
  if (created <=
      most_created * all + least_created * 0.5 * water.total_mass() * expected_speed * expected_speed)
    return;
  throw NumericalError(
      "water.grid_to_points", t,
      fmt::format("water moves with {:.3g} J more than gravity, inflow, walls and rocks gave it (limit "
                  "{:.0f} % of {:.3g} J), its fastest point at {:.3g} m/s with sound at {:.3g} m/s",
                  created, 100 * most_created, all, water.largest_speed(), water.limits().sound_speed),
      water.limits().viscous < water.limits().acoustic
          ? "set 'wall_slip: no_slip', as water this thick does, or lower 'viscosity'"
          : "raise 'fastest_bulk_speed' or 'sound_speed', or lower 'courant'");
}

void Watch::exchange(StateArchive& a) {
  a.value("looked_at", looked_at_);
  a.value("momentum", momentum_);
  a.value("water_gravity_work", water_gravity_work_);
}

}  // namespace sluice
