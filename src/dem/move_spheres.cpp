/// The motion of spheres among spheres, whose rows hold velocity, spin and what both are divided by side by
/// side.

#include <cstring>

#include "dem/dem_state.h"

namespace sluice {

namespace {
/// As RockMotionRow and Push: what moves, a number, what turns, a number.
using Row = double __attribute__((vector_size(64)));

Row load(const void* from) {
  Row row;
  std::memcpy(&row, from, sizeof row);
  return row;
}
void store(const Row& row, void* to) {
  std::memcpy(to, &row, sizeof row);
}
double sum_of(const Row& row) {
  double sum = 0;
  for (int k = 0; k < 8; ++k) sum += row[k];
  return sum;
}
static_assert(sizeof(RockMotionRow) == sizeof(Row) && sizeof(Push) == sizeof(Row));

/// What half a step of `half` seconds adds to a motion. The last operation is an addition of products, so
/// that the compiler fuses it alike wherever this is inlined.
Row half_kick(const Row& motion, const Row& push, double inertia_factor, const Row& gravity_half,
              double half) {
  const double mass = motion[3], size = motion[7];
  const double m = half / mass, t = half / (inertia_factor * (mass * size * size));
  const Row per = {m, m, m, 0.0, t, t, t, 0.0};
  return push * per + gravity_half;
}

Row with_fluid(const Row& push, const Vec3& force, const Vec3& torque) {
  const Row fluid = {force.x(), force.y(), force.z(), 0.0, torque.x(), torque.y(), torque.z(), 0.0};
  return push + fluid;
}

Row fall(const Vec3& gravity, double half) {
  const Row row = {half * gravity.x(), half * gravity.y(), half * gravity.z(), 0.0, 0.0, 0.0, 0.0, 0.0};
  return row;
}
}  // namespace

void DemSystem::Implementation::stop_if_wild(double none, std::size_t begin, std::size_t end,
                                             const StepTime& time) const {
  if (none == 0) return;
  for (std::size_t i = begin; i < end; ++i)
    if (!motions[i].v.allFinite() || !motions[i].w.allFinite()) stop_wild(i, time);
}

void DemSystem::Implementation::move_spheres(DemChunk& chunk, std::size_t begin, std::size_t end,
                                             const StepTime& time, bool goes_on) {
  if (!goes_on) keep_rows(begin, end);
  const double half = 0.5 * time.dt;
  const Row gravity_half = fall(scene.gravity, half);
  const bool in_fluid = !fluid_force.empty();
  Row wild{};  // stays zero while all are numbers
  for (std::size_t i = begin; i < end; ++i) {
    Row motion = load(&motions[i]), on = load(&push[i]);
    if (in_fluid) on = with_fluid(on, fluid_force[i], fluid_torque[i]);
    const Row change = half_kick(motion, on, shape_of(i).inertia.x(), gravity_half, half);
    if (goes_on) motion += change;
    motion += change;
    wild += motion - motion;
    store(motion, &motions[i]);
    move(chunk, i, places[i].x, motions[i], time);
  }
  stop_if_wild(sum_of(wild), begin, end, time);
}

void DemSystem::Implementation::take_from_rows(std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    rocks.x[i] = places[i].x;
    rocks.v[i] = motions[i].v;
    rocks.w[i] = motions[i].w;
  }
}

void DemSystem::Implementation::end_spheres(std::size_t begin, std::size_t end, const StepTime& time) {
  const double half = 0.5 * time.dt;
  const Row gravity_half = fall(scene.gravity, half);
  Row wild{};
  for (std::size_t i = begin; i < end; ++i) {
    const Row motion = load(&motions[i]);
    Row on = load(&push[i]);
    if (!fluid_force.empty()) on = with_fluid(on, fluid_force[i], fluid_torque[i]);
    const Row ended = motion + half_kick(motion, on, shape_of(i).inertia.x(), gravity_half, half);
    wild += ended - ended;
    store(ended, &motions[i]);
  }
  take_from_rows(begin, end);
  stop_if_wild(sum_of(wild), begin, end, time);
}

}  // namespace sluice
