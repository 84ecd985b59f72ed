#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"
#include "base/parallel.h"
#include "dem/dem_state.h"
#include "dem/rigid_motion.h"

namespace sluice {

namespace {
constexpr std::uint64_t steps_per_sample = 100;
constexpr double steps_per_list = 200;  // a rock may go as far as it does in so many on one list
constexpr std::uint64_t lists_per_sort = 8;
}  // namespace

void DemSystem::Implementation::steps_of(double t, double dt, int n) {
  StepTime time{t, dt, false};
  for (int k = 0; k < n; ++k) {
    const bool goes_on = k > 0;
    time = {t + k * dt, dt, steps % steps_per_sample == 0};
    for (MovingWalls& part : moving) part.move(time.t, dt);
    prepare_chunks(dt);
    drift(time, goes_on);
    const bool moved_far =
        std::any_of(chunks.begin(), chunks.end(), [](const DemChunk& chunk) { return chunk.moved_far; });
    if (!list_valid || moved_far) list_pairs(dt);
    if (has_blocky) turn_copies();
    contacts(time);
    give_half_to_walls(dt);
    if (time.sampled) keep_overlaps();
    ++steps;
    now = time.t + dt;
  }
  if (n > 0) finish(time);
}

void DemSystem::Implementation::keep_overlaps() {
  for (const DemChunk& chunk : chunks)
    for (double ratio : chunk.overlaps) {
      overlap_histogram.add(100 * ratio);
      overlap_sum += 100 * ratio;
      overlap_count += 1;
    }
}

void DemSystem::Implementation::prepare_chunks(double dt) {
  // The rocks' first half kick is with the forces of the last step: so is the walls'.
  give_half_to_walls(dt);
  for (DemChunk& chunk : chunks) {
    chunk.elastic = 0;
    chunk.moved_far = false;
    chunk.contacts = 0;
    chunk.overlaps.clear();
    chunk.rates.assign(walls.size(), {});
  }
  make_chunks();
}

void DemSystem::Implementation::make_chunks() {
  const std::size_t used = (count() + pairs.chunk_length() - 1) / pairs.chunk_length();
  while (chunks.size() < used) {
    chunks.emplace_back();
    chunks.back().loads.resize(walls.size());
    chunks.back().rates.resize(walls.size());
  }
}

void DemSystem::Implementation::give_half_to_walls(double dt) {
  for (DemChunk& chunk : chunks)
    for (std::size_t w = 0; w < chunk.rates.size(); ++w) {
      chunk.loads[w].impulse += 0.5 * dt * chunk.rates[w].impulse;
      chunk.loads[w].angular_impulse += 0.5 * dt * chunk.rates[w].angular_impulse;
    }
  if (!moving.empty()) take_half_of_work(dt);
}

void DemSystem::Implementation::take_half_of_work(double dt) {
  for (const MovingWalls& part : moving)
    for (std::size_t w = 0; w < walls.size(); ++w) {
      if (part.walls.all()[w].mesh.triangles.empty()) continue;
      for (DemChunk& chunk : chunks) {
        if (chunk.rates.empty()) continue;
        const Vec3 &force = chunk.rates[w].impulse, &moment = chunk.rates[w].angular_impulse;
        const Vec3 about_centre = moment - part.twist.at.cross(force);
        chunk.wall_work -= 0.5 * dt * (force.dot(part.twist.v) + about_centre.dot(part.twist.w));
      }
    }
}

void DemSystem::Implementation::kick(std::size_t i, double seconds) {
  Vec3 f = push[i].force, moment = push[i].torque;
  if (!fluid_force.empty()) {
    f += fluid_force[i];
    moment += fluid_torque[i];
  }
  rocks.v[i] += seconds * (f / rocks.mass[i] + scene.gravity);
  angular[i] += seconds * moment;
}

void DemSystem::Implementation::drift(const StepTime& time, bool goes_on) {
  if (!only_spheres) {
    if (turned_shapes.size() < count()) turned_shapes.resize(count());
    rim_speed.resize(count());
  }
  places.resize(count());
  motions.resize(count());
  each_chunk([&](std::size_t c, std::size_t begin, std::size_t end) {
    if (goes_on) take_reactions(c);
    if (only_spheres) {
      move_spheres(chunks[c], begin, end, time, goes_on);
    } else {
      for (std::size_t i = begin; i < end; ++i) {
        if (goes_on) end_step(i, time);
        begin_step(chunks[c], i, time);
      }
      turn_rocks(begin, end, time.dt);
      keep_rows(begin, end);
    }
    if (!fluid_force.empty()) count_fluid(chunks[c], begin, end, time.dt);
  });
}

void DemSystem::Implementation::begin_step(DemChunk& chunk, std::size_t i, const StepTime& time) {
  kick(i, 0.5 * time.dt);
  move(chunk, i, rocks.x[i], {rocks.v[i], rocks.mass[i], rocks.w[i], rocks.size[i]}, time);
}

void DemSystem::Implementation::count_fluid(DemChunk& chunk, std::size_t begin, std::size_t end, double dt) {
  for (std::size_t i = begin; i < end; ++i) {
    chunk.fluid_impulse += fluid_force[i] * dt;
    chunk.fluid_work += (fluid_force[i].dot(motions[i].v) + fluid_torque[i].dot(motions[i].w)) * dt;
  }
}

void DemSystem::Implementation::list_pairs(double dt) {
  if (only_spheres)
    each_chunk([&](std::size_t, std::size_t begin, std::size_t end) { take_from_rows(begin, end); });
  if (count() > pairs.chunk_length() && lists % lists_per_sort == 0) sort_in_space();
  ++lists;
  std::vector<double> reach(count());
  double most_reach = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
    if (scene.domain.periodic(k)) most_reach = std::min(most_reach, 0.25 * scene.domain.box.size()[k]);
  parallel_for(count(), [&](std::size_t i) {
    const double radius = rocks.radius[i], least = least_margin * radius;
    const double most = std::max(least, std::min(most_margin * radius, most_reach - radius));
    margin[i] = std::clamp(steps_per_list * dt * rocks.v[i].norm(), least, most);
    reach[i] = radius + margin[i];
  });
  std::vector<std::uint8_t> blocky(has_blocky ? count() : 0);
  for (std::size_t i = 0; i < blocky.size(); ++i) blocky[i] = is_blocky(i) ? 1 : 0;
  pairs.rebuild(rocks.x, reach, scene.domain, blocky);
  make_chunks();
  listed_at = rocks.x;
  list_valid = true;
  room_valid = false;  // its grid allows for the margins only
}

/// Behind the rocks' shapes; after the rocks have been listed, which may sort them.
void DemSystem::Implementation::turn_copies() {
  turned_shapes.resize((1 + face_copies) * count());
  parallel_for(count(), [&](std::size_t i) {
    if (!is_blocky(i)) return;
    const FaceCopies& all = copies_of(i);
    for (std::size_t c = 0; c < face_copies; ++c)
      turned_shapes[copy_of(i, c)] = {rocks.q[i] * all.turns[c], all.semi_axes * rocks.size[i],
                                      turned_shapes[i].m};
  });
}

void DemSystem::Implementation::contacts(const StepTime& time) {
  reactions.resize(pairs.queue_start.back());
  queued.resize(pairs.incoming.size());
  pair_scratch.resize(std::max(pair_scratch.size(), static_cast<std::size_t>(thread_count())));
  each_chunk([&](std::size_t c, std::size_t begin, std::size_t end) {
    PairScratch& scratch = pair_scratch[static_cast<std::size_t>(this_thread())];
    scratch.begin = begin;
    std::fill(push.begin() + static_cast<std::ptrdiff_t>(begin),
              push.begin() + static_cast<std::ptrdiff_t>(end), Push{});
    std::fill(queued.begin() + pairs.out_start[c], queued.begin() + pairs.out_start[c + 1], 0);
    pairs_of(chunks[c], scratch, end, time);
    if (has_walls)
      for (std::size_t i = begin; i < end; ++i) walls_of(chunks[c], i, time);
    if (!moving.empty())
      for (std::size_t i = begin; i < end; ++i) moving_walls_of(chunks[c], i, time);
  });
}

void DemSystem::Implementation::take_reactions(std::size_t c) {
  for (std::size_t k = pairs.in_start[c]; k < pairs.in_start[c + 1]; ++k) {
    const std::uint32_t q = pairs.incoming[k];
    const Push* waits = &reactions[pairs.queue_start[q]];
    for (const Push* const end = waits + queued[q]; waits != end; ++waits) {
      Push& on = push[static_cast<std::size_t>(waits->rock)];
      on.force += waits->force;
      on.torque += waits->torque;
    }
  }
}

void DemSystem::Implementation::stop_fast(std::size_t i, const Vec3& v, const StepTime& time) const {
  if (!v.allFinite()) stop_wild(i, time);
  throw NumericalError("rocks.substeps", time.t,
                       fmt::format("rock {} moves {:.3g} radius in one step (limit {})", rocks.id[i],
                                   time.dt * v.norm() / (0.5 * rocks.size[i]), longest_move),
                       "raise 'steps_per_contact' or check the speeds that enter");
}

void DemSystem::Implementation::stop_wild(std::size_t i, const StepTime& time) const {
  throw NumericalError("rocks.substeps", time.t,
                       fmt::format("rock {} has a velocity that is no number", rocks.id[i]),
                       "raise 'steps_per_contact' or lower 'network_fraction'");
}

void DemSystem::Implementation::end_step(std::size_t i, const StepTime& time) {
  kick(i, 0.5 * time.dt);
  if (!std::isfinite(rocks.v[i].sum()) || !std::isfinite(angular[i].sum())) stop_wild(i, time);
}

void DemSystem::Implementation::finish(const StepTime& time) {
  each_chunk([&](std::size_t c, std::size_t begin, std::size_t end) {
    take_reactions(c);
    if (only_spheres) return end_spheres(begin, end, time);
    for (std::size_t i = begin; i < end; ++i) {
      end_step(i, time);
      rocks.w[i] = angular_velocity(rocks.q[i], angular[i], per_inertia[i]);
    }
  });
}

}  // namespace sluice
