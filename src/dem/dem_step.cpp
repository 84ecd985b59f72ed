#include <fmt/format.h>

#include <cmath>

#include "base/errors.h"
#include "base/parallel.h"
#include "dem/dem_state.h"
#include "dem/rigid_motion.h"

namespace sluice {

namespace {
constexpr std::uint64_t steps_per_sample = 100;
constexpr double longest_move = 0.5;  // of the radius in one step: beyond it contacts would be missed
}  // namespace

void DemSystem::Implementation::step(double t, double dt) {
  const StepTime time{t, dt, steps % steps_per_sample == 0};
  prepare_chunks(dt);
  drift(time);
  double moved2 = 0;
  for (const DemChunk& chunk : chunks) moved2 = std::max(moved2, chunk.moved2);
  if (!list_valid || moved2 >= 0.25 * skin * skin) list_pairs();
  contacts(time);
  finish(time);
  give_half_to_walls(dt);

  if (time.sampled)
    for (const DemChunk& chunk : chunks)
      for (double ratio : chunk.overlaps) {
        overlap_histogram.add(100 * ratio);
        overlap_sum += 100 * ratio;
        overlap_count += 1;
      }
  ++steps;
  now = t + dt;
}

void DemSystem::Implementation::prepare_chunks(double dt) {
  // The rocks' first half kick is with the forces of the last step: so is the walls'.
  give_half_to_walls(dt);
  const std::size_t used = (count() + chunk_length - 1) / chunk_length;
  if (chunks.size() < used) chunks.resize(used);
  for (DemChunk& chunk : chunks) {
    chunk.elastic = chunk.moved2 = 0;
    chunk.contacts = 0;
    chunk.overlaps.clear();
    chunk.loads.resize(walls.size());
    chunk.rates.assign(walls.size(), {});
  }
}

void DemSystem::Implementation::give_half_to_walls(double dt) {
  for (DemChunk& chunk : chunks)
    for (std::size_t w = 0; w < chunk.rates.size(); ++w) {
      chunk.loads[w].impulse += 0.5 * dt * chunk.rates[w].impulse;
      chunk.loads[w].angular_impulse += 0.5 * dt * chunk.rates[w].angular_impulse;
    }
}

void DemSystem::Implementation::kick(std::size_t i, double seconds) {
  Vec3 f = force[i], moment = torque[i];
  if (!fluid_force.empty()) {
    f += fluid_force[i];
    moment += fluid_torque[i];
  }
  rocks.v[i] += seconds * (f / rocks.mass[i] + scene.gravity);
  if (only_spheres) {
    rocks.w[i] += seconds * moment / inertia(i).x();
  } else {
    angular[i] += seconds * moment;
    rocks.w[i] = angular_velocity(rocks.q[i], angular[i], inertia(i));
  }
}

void DemSystem::Implementation::drift(const StepTime& time) {
  bodies.resize(count());
  parallel_chunks(count(), chunk_length, [&](std::size_t c, std::size_t begin, std::size_t end) {
    DemChunk& chunk = chunks[c];
    for (std::size_t i = begin; i < end; ++i) {
      kick(i, 0.5 * time.dt);
      const Vec3 move = time.dt * rocks.v[i];
      const double most = longest_move * 0.5 * rocks.size[i];
      if (!(move.squaredNorm() <= most * most))
        throw NumericalError("rocks.substeps", time.t,
                             fmt::format("rock {} moves {:.3g} radius in one step (limit {})", rocks.id[i],
                                         move.norm() / (0.5 * rocks.size[i]), longest_move),
                             "raise 'steps_per_contact' or check the speeds that enter");
      rocks.x[i] += move;
      if (is_sphere[static_cast<std::size_t>(rocks.shape[i])]) {
        rotate_sphere(rocks.q[i], rocks.w[i], time.dt);
      } else {
        rotate_freely(rocks.q[i], angular[i], inertia(i), time.dt);
        rocks.w[i] = angular_velocity(rocks.q[i], angular[i], inertia(i));
      }
      Vec3 moved = rocks.x[i] - listed_at[i];
      if (periodic) {
        rocks.x[i] = scene.domain.wrapped(rocks.x[i]);
        moved = scene.domain.nearest_image(moved);
      }
      chunk.moved2 = std::max(chunk.moved2, moved.squaredNorm());
      chunk.mass_seconds += rocks.mass[i] * time.dt;
      if (!fluid_force.empty()) {
        chunk.fluid_impulse += fluid_force[i] * time.dt;
        chunk.fluid_work += (fluid_force[i].dot(rocks.v[i]) + fluid_torque[i].dot(rocks.w[i])) * time.dt;
      }
      bodies[i] = {rocks.x[i], rocks.radius[i], rocks.v[i],        rocks.mass[i],
                   rocks.w[i], rocks.size[i],   rocks.material[i], rocks.shape[i]};
    }
  });
}

void DemSystem::Implementation::list_pairs() {
  pairs.rebuild(rocks.x, rocks.radius, skin, scene.domain);
  listed_at = rocks.x;
  list_valid = true;
  room_valid = false;  // its grid allows for the skin only
}

void DemSystem::Implementation::contacts(const StepTime& time) {
  own_force.resize(count());
  own_torque.resize(count());
  pair_force.resize(pairs.pair_count());
  parallel_chunks(count(), chunk_length, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      own_force[i].setZero();
      own_torque[i].setZero();
      pairs_of(chunks[c], i, time);
      if (has_walls) walls_of(chunks[c], i, time);
    }
  });
}

void DemSystem::Implementation::finish(const StepTime& time) {
  parallel_chunks(count(), chunk_length, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Vec3 f = own_force[i], moment = own_torque[i];
      for (std::size_t k = pairs.in_start[i]; k < pairs.in_start[i + 1]; ++k) {
        const std::size_t p = pairs.in_pair[k];
        if (!pairs.touching[p]) continue;
        f -= pair_force[p].force;
        moment += pair_force[p].torque;
      }
      force[i] = f;
      torque[i] = moment;
      kick(i, 0.5 * time.dt);
      if (!std::isfinite(rocks.v[i].sum()) || !std::isfinite(rocks.w[i].sum()))
        throw NumericalError("rocks.substeps", time.t,
                             fmt::format("rock {} has a velocity that is no number", rocks.id[i]),
                             "raise 'steps_per_contact' or lower 'network_fraction'");
    }
  });
}

}  // namespace sluice
