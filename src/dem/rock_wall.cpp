#include <algorithm>

#include "dem/dem_state.h"

namespace sluice {

namespace {
constexpr double wall_skin = 0.3;       // of the radius: how far a rock moves on one list of triangles
constexpr double deepest_start = 0.25;  // of the smallest semi-axis
}  // namespace

void DemSystem::Implementation::walls_of(DemChunk& chunk, std::size_t i, const StepTime& time) {
  RockWalls& near = near_walls[i];
  if (!find_touches(chunk, i, {still, surface}, {places[i].x, rocks.q[i]}, near)) return;
  for (WallTouch& touch : near.touches) {
    const Vec3 belt = along_surface(still.surface_velocity(touch.wall, touch.point), touch.normal);
    touch_wall(chunk, i, touch, {belt, belt, Vec3::Zero()}, time);
  }
  count_touches(chunk, i, near, time);
}

void DemSystem::Implementation::moving_walls_of(DemChunk& chunk, std::size_t i, const StepTime& time) {
  for (MovingWalls& part : moving) {
    RockWalls& near = part.near[i];
    const RockPlace place{part.now.to_rest(places[i].x), part.now.q.conjugate() * rocks.q[i]};
    if (!find_touches(chunk, i, {part.walls, part.surface}, place, near)) continue;
    for (WallTouch& touch : near.touches) {
      WallTouch in_space = part.to_space(touch);
      touch_wall(chunk, i, in_space, part.surface_motion(in_space, time.dt), time);
      part.keep_history(in_space, touch);
    }
    count_touches(chunk, i, near, time);
  }
}

/// Copies at one place of a wall are one contact.
void DemSystem::Implementation::count_touches(DemChunk& chunk, std::size_t i, const RockWalls& near,
                                              const StepTime& time) const {
  const std::span<const WallTouch> touches(near.touches);
  for (std::size_t k = 0; k < touches.size(); ++k) {
    const auto is_deeper = [&](const WallTouch& other) {
      if (other.patch != touches[k].patch || other.feature != touches[k].feature) return false;
      return other.overlap > touches[k].overlap ||
             (other.overlap == touches[k].overlap && other.copy < touches[k].copy);
    };
    if (is_blocky(i) && std::any_of(touches.begin(), touches.end(), is_deeper)) continue;
    count_contact(chunk, 2 * touches[k].overlap / rocks.size[i], time);
  }
}

/// Contacts of a rock, or of each of its copies, into the chunk's scratch.
void DemSystem::Implementation::find_superquadric(DemChunk& chunk, std::size_t i, const WallsAndSurface& part,
                                                  const RockPlace& place, RockWalls& near) {
  Superquadric shape = superquadric(i, place.x);
  const double deepest = deepest_start * shape.semi_axes.minCoeff();
  const auto find = [&](std::size_t copy, const Quat& q, std::span<const WallTouch> before) {
    shape.q = q;
    find_superquadric_contacts(part.surface, near.parts, copy, shape, rocks.radius[i], deepest, before,
                               chunk.scratch);
  };
  near.parts.begin_search(is_blocky(i) ? face_copies : 1);
  if (!is_blocky(i)) return find(0, place.q, near.touches);
  const FaceCopies& copies_here = copies_of(i);
  shape.semi_axes = copies_here.semi_axes * rocks.size[i];
  WallScratch& scratch = chunk.scratch;
  scratch.of_copies.clear();
  auto before = near.touches.begin();
  for (std::size_t c = 0; c < face_copies; ++c) {
    const int copy = static_cast<int>(c);
    const auto next =
        std::find_if(before, near.touches.end(), [&](const WallTouch& t) { return t.copy != copy; });
    find(c, place.q * copies_here.turns[c], {before, next});
    for (WallTouch& touch : scratch.found) touch.copy = copy;
    scratch.of_copies.insert(scratch.of_copies.end(), scratch.found.begin(), scratch.found.end());
    before = next;
  }
  scratch.found.swap(scratch.of_copies);
}

bool DemSystem::Implementation::find_touches(DemChunk& chunk, std::size_t i, const WallsAndSurface& part,
                                             const RockPlace& place, RockWalls& near) {
  const Body body = body_of(i);
  const double margin = wall_skin * body.radius;
  if (!((place.x - near.at).squaredNorm() < margin * margin)) {
    near.at = place.x;
    part.walls.query().triangles_in(Box{place.x, place.x}.grown(body.radius + margin), near.parts.triangles);
    std::erase_if(near.parts.triangles, [&](int t) { return part.surface.triangle(t).patch < 0; });
    near.parts.list(part.surface);
  }
  if (near.parts.triangles.empty() && near.touches.empty()) return false;
  const bool round = has_sphere_shape(body.shape);
  near.parts.follow(place.x, place.q, body.radius, !round);
  if (near.parts.quiet() && near.touches.empty()) return false;
  if (round) {
    const double gap = find_sphere_contacts(part.surface, near.parts.triangles, place.x, body.radius,
                                            near.touches, chunk.scratch);
    near.parts.set_least_gap(gap, body.radius);
  } else {
    find_superquadric(chunk, i, part, place, near);
    near.parts.end_search();
  }
  if (chunk.scratch.found.empty() && near.touches.empty()) return false;
  carry_history(near.touches, chunk.scratch, [&](const WallTouch& old) {
    const int wall_material = walls.all()[static_cast<std::size_t>(old.wall)].material;
    const double k_t = config.tangential_ratio * limits.stiffness_per_size * body.size;
    const double k_spring = spring_stiffness(law(body.material, wall_material), k_t, 0.5 * body.size);
    const double share = is_blocky(i) ? face_share : 1;
    const double lost = share * 0.5 * k_spring * old.spring.squaredNorm();
    chunk.lost_friction += lost;
    chunk.loads[static_cast<std::size_t>(old.wall)].sliding_energy += lost;
  });
  return true;
}

void DemSystem::Implementation::touch_wall(DemChunk& chunk, std::size_t i, WallTouch& touch,
                                           const SurfaceMotion& moves, const StepTime& time) {
  const Body body = body_of(i);
  check_overlap(chunk, i, 2 * touch.overlap / body.size, time);
  const ContactLaw& pair_law = law(body.material, walls.all()[static_cast<std::size_t>(touch.wall)].material);
  const double k_n = limits.stiffness_per_size * body.size;
  const Vec3 arm = touch.point - body.x;
  const Indentation at{touch.overlap, 0.5 * body.size, 1 / yield(i, arm, touch.normal)};
  const ContactConstants constants =
      contact_constants(pair_law, k_n, config.tangential_ratio, at.mass_effective, config.end_of_contact);
  const Vec3 velocity = body.v + body.w.cross(arm) - moves.velocity;
  const double share = is_blocky(i) ? face_share : 1;
  if (pair_law.tangential == Tangential::partial_slip) touch.rings.resize(shear_rings, Vec3::Zero());
  ContactForce contact =
      law_force(pair_law, constants, at, touch.normal, velocity, time.dt, {touch.spring, touch.rings});
  Vec3 moment = Vec3::Zero();
  double lost_rolling = 0;
  if (has_rolling && pair_law.rolling > 0) {
    const double radius = 0.5 * body.size;
    const RollingConstants rolling =
        rolling_constants(pair_law.rolling, radius, normal_stiffness(pair_law, k_n, at),
                          1.4 * body.mass * radius * radius, contact.normal);
    const Vec3 spin = body.w - moves.spin;
    moment = share * rolling_torque(rolling, spin, time.dt, touch.turned);
    lost_rolling = -moment.dot(spin) * time.dt;
  }
  contact.force *= share;
  contact.lost_normal *= share;
  contact.lost_friction *= share;
  contact.elastic *= share;
  push[i].force += contact.force;
  push[i].torque += arm.cross(contact.force) + moment;
  chunk.lost_normal += contact.lost_normal;
  chunk.lost_friction += contact.lost_friction + lost_rolling;
  chunk.wall_work += contact.force.dot(moves.belt) * time.dt;
  chunk.elastic += contact.elastic;

  WallLoad& load = chunk.loads[static_cast<std::size_t>(touch.wall)];
  WallLoad& rate = chunk.rates[static_cast<std::size_t>(touch.wall)];
  rate.impulse -= contact.force;
  rate.angular_impulse -= touch.point.cross(contact.force) + moment;
  load.sliding_energy += contact.lost_friction;
  load.impact_energy += contact.lost_normal;
}

}  // namespace sluice
