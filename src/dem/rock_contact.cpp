#include <fmt/format.h>

#include "base/errors.h"
#include "dem/dem_state.h"

namespace sluice {

void DemSystem::Implementation::note_overlap(DemChunk& chunk, std::size_t i, double ratio,
                                             const StepTime& time) const {
  if (!(ratio <= config.overlap_limit))
    throw NumericalError(
        "rocks.substeps", time.t,
        fmt::format("rock {} overlap is {:.3g} radius (limit {})", rocks.id[i], ratio, config.overlap_limit),
        "raise 'impact_speed' or 'stiffness_per_size', or lower 'network_fraction'");
  chunk.overlap_most = std::max(chunk.overlap_most, ratio);
  ++chunk.contacts;
  if (time.sampled) chunk.overlaps.push_back(ratio);
}

/// Acceleration along n of the contact point under a unit force along n [1/kg].
double DemSystem::Implementation::yield(std::size_t i, const Vec3& arm, const Vec3& n) const {
  const double by_mass = 1 / rocks.mass[i];
  if (is_sphere[static_cast<std::size_t>(rocks.shape[i])]) return by_mass;
  const Vec3 lever = rocks.q[i].conjugate() * arm.cross(n);
  return by_mass + lever.cwiseAbs2().cwiseQuotient(inertia(i)).sum();
}

bool DemSystem::Implementation::superquadrics_touch(std::size_t i, std::size_t p, const Vec3& separation,
                                                    Touch& touch) {
  const auto j = static_cast<std::size_t>(pairs.second[p]);
  ContactGeometry geometry;
  const PairOutcome outcome = superquadric_pair(
      superquadric(i, bodies[i].x), superquadric(j, bodies[i].x + separation), pairs.memory[p], geometry);
  if (outcome == PairOutcome::separated || geometry.overlap <= 0) return false;
  touch = {geometry.normal, geometry.point, geometry.overlap, 0};
  touch.mass_effective = 1 / (yield(i, geometry.point - bodies[i].x, geometry.normal) +
                              yield(j, geometry.point - bodies[i].x - separation, geometry.normal));
  return true;
}

void DemSystem::Implementation::pairs_of(DemChunk& chunk, std::size_t i, const StepTime& time) {
  const Body& a = bodies[i];
  for (std::size_t p = pairs.start[i]; p < pairs.start[i + 1]; ++p) {
    const Body& b = bodies[static_cast<std::size_t>(pairs.second[p])];
    Vec3 separation = b.x - a.x;
    if (periodic) separation = scene.domain.nearest_image(separation);
    const double distance2 = separation.squaredNorm(), reach = a.radius + b.radius;
    bool touches = distance2 < reach * reach;
    Touch touch;
    if (touches) {
      if (only_spheres ||
          (is_sphere[static_cast<std::size_t>(a.shape)] && is_sphere[static_cast<std::size_t>(b.shape)])) {
        const double distance = std::sqrt(distance2);
        touch.overlap = reach - distance;
        touch.normal = distance > 0 ? Vec3(separation / distance) : Vec3(Vec3::UnitZ());
        touch.point = a.x + (a.radius - 0.5 * touch.overlap) * touch.normal;
        touch.mass_effective = a.mass * b.mass / (a.mass + b.mass);
      } else {
        touches = superquadrics_touch(i, p, separation, touch);
      }
    }
    if (touches)
      touch_pair(chunk, i, p, touch, a.x + separation, time);
    else if (pairs.touching[p])
      end_pair(chunk, i, p);
  }
}

void DemSystem::Implementation::touch_pair(DemChunk& chunk, std::size_t i, std::size_t p, const Touch& touch,
                                           const Vec3& image, const StepTime& time) {
  const auto j = static_cast<std::size_t>(pairs.second[p]);
  const Body &a = bodies[i], &b = bodies[j];
  note_overlap(chunk, a.size <= b.size ? i : j, 2 * touch.overlap / std::min(a.size, b.size), time);
  const ContactLaw& pair_law = law(a.material, b.material);
  const double k_n = limits.stiffness_per_size * 2 * a.size * b.size / (a.size + b.size);
  const ContactConstants constants =
      contact_constants(pair_law, k_n, config.tangential_ratio, touch.mass_effective, config.end_of_contact);
  const Vec3 arm_a = touch.point - a.x, arm_b = touch.point - image;
  const Vec3 velocity = a.v - b.v + a.w.cross(arm_a) - b.w.cross(arm_b);
  const ContactForce contact =
      contact_force(constants, touch.normal, touch.overlap, velocity, time.dt, pairs.spring[p]);
  Vec3 torque_b = arm_b.cross(-contact.force);
  own_force[i] += contact.force;
  own_torque[i] += arm_a.cross(contact.force);
  chunk.lost_normal += contact.lost_normal;
  chunk.lost_friction += contact.lost_friction;
  chunk.elastic += contact.elastic;

  if (has_rolling && pair_law.rolling > 0) {
    const double radius_a = 0.5 * a.size, radius_b = 0.5 * b.size;
    const double about_a = 1.4 * a.mass * radius_a * radius_a, about_b = 1.4 * b.mass * radius_b * radius_b;
    const RollingConstants rolling =
        rolling_constants(pair_law.rolling, radius_a * radius_b / (radius_a + radius_b), k_n,
                          about_a * about_b / (about_a + about_b), contact.normal);
    const Vec3 spin = a.w - b.w;
    const Vec3 moment = rolling_torque(rolling, spin, time.dt, pairs.turned[p]);
    own_torque[i] += moment;
    torque_b -= moment;
    chunk.lost_friction -= moment.dot(spin) * time.dt;
  }
  pair_force[p] = {contact.force, torque_b};
  pairs.touching[p] = 1;
}

void DemSystem::Implementation::end_pair(DemChunk& chunk, std::size_t i, std::size_t p) {
  // A spring that is still stretched snaps back.
  const Body &a = bodies[i], &b = bodies[static_cast<std::size_t>(pairs.second[p])];
  const double k_n = limits.stiffness_per_size * 2 * a.size * b.size / (a.size + b.size);
  chunk.lost_friction += 0.5 * config.tangential_ratio * k_n * pairs.spring[p].squaredNorm();
  pairs.touching[p] = 0;
  pairs.spring[p].setZero();
  if (has_rolling) pairs.turned[p].setZero();
}

}  // namespace sluice
