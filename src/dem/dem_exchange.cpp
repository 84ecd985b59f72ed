#include <fmt/format.h>

#include "base/parallel.h"
#include "dem/dem_state.h"

namespace sluice {

namespace {
template <class T>
std::size_t bytes_of(const std::vector<T>& v) {
  return v.capacity() * sizeof(T);
}
template <std::size_t N>
void put(std::array<double, N>& row, std::size_t at, const Vec3& v) {
  for (int k = 0; k < 3; ++k) row[at + static_cast<std::size_t>(k)] = v[k];
}
template <std::size_t N>
Vec3 take(const std::array<double, N>& row, std::size_t at) {
  return {row[at], row[at + 1], row[at + 2]};
}
}  // namespace

void DemSystem::Implementation::exchange_rocks(StateArchive& archive) {
  archive.values("id", rocks.id);
  archive.values("x", rocks.x);
  archive.values("v", rocks.v);
  archive.values("w", rocks.w);
  archive.values("q", rocks.q);
  archive.values("shape", rocks.shape);
  archive.values("material", rocks.material);
  archive.values("source", rocks.source);
  archive.values("size", rocks.size);
  archive.values("mass", rocks.mass);
  archive.values("radius", rocks.radius);
  archive.values("birth", rocks.birth);
  archive.values("wet_dose", rocks.wet_dose);
  archive.values("wetted", rocks.wetted);
  archive.values("angular_momentum", angular);
  if (archive.loading() && !only_spheres) {
    per_inertia.clear();
    for (std::size_t i = 0; i < count(); ++i) per_inertia.push_back(inertia(i).cwiseInverse());
  }
  std::vector<Vec3> force, torque;
  for (const Push& one : push) {
    force.push_back(one.force);
    torque.push_back(one.torque);
  }
  archive.values("force", force);
  archive.values("torque", torque);
  push.resize(force.size());
  for (std::size_t i = 0; i < push.size(); ++i) {
    push[i].force = force[i];
    push[i].torque = torque[i];
  }
  archive.values("fluid_force", fluid_force);
  archive.values("fluid_torque", fluid_torque);
  archive.values("listed_at", listed_at);
  archive.values("margin", margin);
  archive.value("list_valid", list_valid);
  archive.value("next_id", next_id);
  archive.value("steps", steps);
  archive.value("lists", lists);
  archive.value("now", now);
  archive.value("momentum_added", momentum_added);
  archive.value("momentum_removed", momentum_removed);
  archive.value("energy_added", energy_added);
  archive.value("energy_removed", energy_removed);
}

void DemSystem::Implementation::exchange_tallies(StateArchive& archive) {
  std::vector<std::array<double, 12>> sums;
  std::vector<std::array<double, 14>> loads;
  for (const DemChunk& c : chunks) {
    std::array<double, 12> row{c.lost_normal,  c.lost_friction, c.wall_work, c.fluid_work,
                               c.mass_seconds, c.overlap_most,  c.elastic,   static_cast<double>(c.contacts)};
    put(row, 8, c.fluid_impulse);
    row[11] = c.gravity_work;
    sums.push_back(row);
    for (std::size_t w = 0; w < c.loads.size(); ++w) {
      const WallLoad& load = c.loads[w];
      std::array<double, 14> flat{};
      put(flat, 0, load.impulse);
      put(flat, 3, load.angular_impulse);
      flat[6] = load.sliding_energy;
      flat[7] = load.impact_energy;
      put(flat, 8, c.rates[w].impulse);
      put(flat, 11, c.rates[w].angular_impulse);
      loads.push_back(flat);
    }
  }
  archive.values("tallies", sums);
  archive.values("loads", loads);
  archive.values("overlap_histogram", overlap_histogram.counts());
  archive.value("overlap_sum", overlap_sum);
  archive.value("overlap_count", overlap_count);
  if (!archive.loading()) return;
  chunks.assign(sums.size(), {});
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    DemChunk& chunk = chunks[c];
    const auto& row = sums[c];
    chunk.lost_normal = row[0];
    chunk.lost_friction = row[1];
    chunk.wall_work = row[2];
    chunk.fluid_work = row[3];
    chunk.mass_seconds = row[4];
    chunk.overlap_most = row[5];
    chunk.elastic = row[6];
    chunk.contacts = static_cast<std::uint64_t>(row[7]);
    chunk.fluid_impulse = take(row, 8);
    chunk.gravity_work = row[11];
    for (std::size_t w = 0; w < walls.size(); ++w) {
      const auto& flat = loads[c * walls.size() + w];
      chunk.loads.push_back({take(flat, 0), take(flat, 3), flat[6], flat[7]});
      chunk.rates.push_back({take(flat, 8), take(flat, 11), 0, 0});
    }
  }
}

void DemSystem::Implementation::exchange_walls(StateArchive& archive) {
  exchange_touches(archive, near_walls, has_walls ? count() : 0);
  for (MovingWalls& part : moving) {
    archive.enter(fmt::format("moving_walls.{}", &part - moving.data()));
    exchange_touches(archive, part.near, count());
    archive.leave();
    if (archive.loading()) part.place(now);
  }
}

void DemSystem::Implementation::exchange_touches(StateArchive& archive, std::vector<RockWalls>& near,
                                                 std::size_t length) {
  std::vector<std::array<int, 6>> labels;  // rock, patch, wall, feature, side, copy
  std::vector<std::array<double, 16>> values;
  std::vector<Vec3> rings;  // of those that have some, one after the other
  for (std::size_t i = 0; i < near.size(); ++i)
    for (const WallTouch& touch : near[i].touches) {
      labels.push_back({static_cast<int>(i), touch.patch, touch.wall, touch.feature, touch.side, touch.copy});
      std::array<double, 16> row{};
      put(row, 0, touch.normal);
      put(row, 3, touch.spring);
      put(row, 6, touch.turned);
      put(row, 9, touch.start);
      put(row, 12, touch.point);
      row[15] = touch.overlap;
      values.push_back(row);
      rings.insert(rings.end(), touch.rings.begin(), touch.rings.end());
    }
  archive.values("wall_touch_labels", labels);
  archive.values("wall_touches", values);
  archive.values("wall_rings", rings);
  if (!archive.loading()) return;
  // Which triangles are near is looked up again: contacts do not depend on what else is on the list.
  near.assign(length, {});
  auto next = rings.cbegin();
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const auto& [rock, patch, wall, feature, side, copy] = labels[k];
    const auto& row = values[k];
    WallTouch touch{patch,   wall,         feature,      side,         take(row, 0), take(row, 12),
                    row[15], take(row, 3), take(row, 6), take(row, 9), copy,         {}};
    const auto at = static_cast<std::size_t>(rock);
    const int wall_material = walls.all()[static_cast<std::size_t>(wall)].material;
    if (law(rocks.material[at], wall_material).tangential == Tangential::partial_slip) {
      touch.rings.assign(next, next + shear_rings);
      next += shear_rings;
    }
    near[at].touches.push_back(std::move(touch));
  }
}

void DemSystem::Implementation::exchange(StateArchive& archive) {
  archive.enter("rocks");
  exchange_rocks(archive);
  pairs.exchange(archive);
  exchange_tallies(archive);
  exchange_walls(archive);
  archive.leave();
  if (archive.loading()) room_valid = false;
}

std::size_t DemSystem::Implementation::memory_bytes() const {
  std::size_t bytes = pairs.memory_bytes() + room.memory_bytes() + surface.memory_bytes();
  bytes += bytes_of(rocks.id) + bytes_of(rocks.x) + bytes_of(rocks.v) + bytes_of(rocks.w) + bytes_of(rocks.q);
  bytes += bytes_of(rocks.shape) + bytes_of(rocks.material) + bytes_of(rocks.source) + bytes_of(rocks.size);
  bytes += bytes_of(rocks.mass) + bytes_of(rocks.radius) + bytes_of(rocks.birth) + bytes_of(rocks.wet_dose);
  bytes += bytes_of(places) + bytes_of(motions) + bytes_of(angular) + bytes_of(push) + bytes_of(fluid_force);
  bytes += bytes_of(fluid_torque) + bytes_of(listed_at) + bytes_of(margin);
  bytes += bytes_of(turned_shapes) + bytes_of(rim_speed) + bytes_of(per_inertia) + bytes_of(reactions) +
           bytes_of(queued) + bytes_of(room_reach) + bytes_of(near_walls);
  for (const PairScratch& scratch : pair_scratch)
    bytes += scratch.spheres.memory_bytes() + bytes_of(scratch.shaped) + bytes_of(scratch.shaped_pairs) +
             bytes_of(scratch.geometry) + bytes_of(scratch.outcome) + bytes_of(scratch.repeated);
  const auto add_near = [&](const std::vector<RockWalls>& all) {
    for (const RockWalls& near : all) bytes += near.parts.memory_bytes() + bytes_of(near.touches);
  };
  add_near(near_walls);
  for (const MovingWalls& part : moving) {
    bytes += part.surface.memory_bytes() + bytes_of(part.near);
    add_near(part.near);
  }
  for (const DemChunk& chunk : chunks)
    bytes += sizeof(chunk) + bytes_of(chunk.loads) + bytes_of(chunk.overlaps) + bytes_of(chunk.scratch.hits) +
             bytes_of(chunk.scratch.found) + bytes_of(chunk.scratch.of_copies);
  return bytes;
}

}  // namespace sluice
