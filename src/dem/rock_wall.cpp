#include "dem/dem_state.h"

namespace sluice {

namespace {
constexpr double wall_skin = 0.3;       // of the radius: how far a rock moves on one list of triangles
constexpr double deepest_start = 0.25;  // of the smallest semi-axis
}  // namespace

void DemSystem::Implementation::walls_of(DemChunk& chunk, std::size_t i, const StepTime& time) {
  const Body body = body_of(i);
  RockWalls& near = near_walls[i];
  const double margin = wall_skin * body.radius;
  if (!((body.x - near.at).squaredNorm() < margin * margin)) {
    near.at = body.x;
    walls.query().triangles_in(Box{body.x, body.x}.grown(body.radius + margin), near.triangles);
    std::erase_if(near.triangles, [&](int t) { return surface.triangle(t).patch < 0; });
  }
  if (near.triangles.empty() && near.touches.empty()) return;
  if (is_sphere[static_cast<std::size_t>(body.shape)]) {
    find_sphere_contacts(surface, near.triangles, body.x, body.radius, near.touches, chunk.scratch);
  } else {
    const Superquadric shape = superquadric(i, body.x);
    find_superquadric_contacts(surface, near.triangles, shape, body.radius,
                               deepest_start * shape.semi_axes.minCoeff(), near.touches, chunk.scratch);
  }
  if (chunk.scratch.found.empty() && near.touches.empty()) return;
  carry_history(near.touches, chunk.scratch, [&](const WallTouch& old) {
    const int wall_material = walls.all()[static_cast<std::size_t>(old.wall)].material;
    const double k_t = config.tangential_ratio * limits.stiffness_per_size * body.size;
    const double k_spring = spring_stiffness(law(body.material, wall_material), k_t, 0.5 * body.size);
    const double lost = 0.5 * k_spring * old.spring.squaredNorm();
    chunk.lost_friction += lost;
    chunk.loads[static_cast<std::size_t>(old.wall)].sliding_energy += lost;
  });
  for (WallTouch& touch : near.touches) touch_wall(chunk, i, touch, time);
}

void DemSystem::Implementation::touch_wall(DemChunk& chunk, std::size_t i, WallTouch& touch,
                                           const StepTime& time) {
  const Body body = body_of(i);
  note_overlap(chunk, i, 2 * touch.overlap / body.size, time);
  const ContactLaw& pair_law = law(body.material, walls.all()[static_cast<std::size_t>(touch.wall)].material);
  const double k_n = limits.stiffness_per_size * body.size;
  const Vec3 arm = touch.point - body.x;
  const Indentation at{touch.overlap, 0.5 * body.size, 1 / yield(i, arm, touch.normal)};
  const ContactConstants constants =
      contact_constants(pair_law, k_n, config.tangential_ratio, at.mass_effective, config.end_of_contact);
  const Vec3 surface_velocity = walls.surface_velocity(touch.wall, touch.point);
  const Vec3 velocity = body.v + body.w.cross(arm) - surface_velocity;
  const ContactForce contact =
      plain_laws ? contact_force(constants, touch.normal, touch.overlap, velocity, time.dt, touch.spring)
                 : law_force(pair_law, constants, at, touch.normal, velocity, time.dt, touch.spring);
  Vec3 moment = Vec3::Zero();
  double lost_rolling = 0;
  if (has_rolling && pair_law.rolling > 0) {
    const double radius = 0.5 * body.size;
    const RollingConstants rolling =
        rolling_constants(pair_law.rolling, radius, normal_stiffness(pair_law, k_n, at),
                          1.4 * body.mass * radius * radius, contact.normal);
    moment = rolling_torque(rolling, body.w, time.dt, touch.turned);
    lost_rolling = -moment.dot(body.w) * time.dt;
  }
  force[i] += contact.force;
  torque[i] += arm.cross(contact.force) + moment;
  chunk.lost_normal += contact.lost_normal;
  chunk.lost_friction += contact.lost_friction + lost_rolling;
  chunk.wall_work += contact.force.dot(surface_velocity) * time.dt;
  chunk.elastic += contact.elastic;

  WallLoad& load = chunk.loads[static_cast<std::size_t>(touch.wall)];
  WallLoad& rate = chunk.rates[static_cast<std::size_t>(touch.wall)];
  rate.impulse -= contact.force;
  rate.angular_impulse -= touch.point.cross(contact.force) + moment;
  load.sliding_energy += contact.lost_friction;
  load.impact_energy += contact.lost_normal;
}

}  // namespace sluice
