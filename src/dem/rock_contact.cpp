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

/// Whether two rocks that were some distance apart cannot have met in this step.
bool DemSystem::Implementation::keeps_clear(std::size_t p, const Body& a, const Body& b, double dt) {
  // Free rotation changes the angular velocity within a step, by far less than this.
  constexpr double rotation_margin = 1.05;
  double& clear = pairs.clear[p];
  if (clear <= 0) return false;
  clear -= dt * ((a.v - b.v).norm() + rotation_margin * (a.w.norm() * a.radius + b.w.norm() * b.radius));
  return clear > 0;
}

void DemSystem::Implementation::find_candidates(DemChunk& chunk, PairScratch& scratch, std::size_t c,
                                                std::size_t begin, std::size_t end, double dt) {
  scratch.candidates.clear();
  scratch.shaped.clear();
  std::uint32_t slot = pairs.out_start[c];
  for (std::size_t i = begin; i < end; ++i) {
    const Body& a = bodies[i];
    for (std::size_t p = pairs.start[i]; p < pairs.start[i + 1]; ++p) {
      const auto j = static_cast<std::size_t>(pairs.second[p]);
      const std::uint32_t own_slot = j >= end ? slot++ : Candidate::no_slot;
      const Body& b = bodies[j];
      const bool shaped = !only_spheres && !(has_sphere_shape(a.shape) && has_sphere_shape(b.shape));
      if (shaped && keeps_clear(p, a, b, dt)) continue;
      Vec3 separation = b.x - a.x;
      if (periodic) separation = scene.domain.nearest_image(separation);
      const double distance2 = separation.squaredNorm(), reach = a.radius + b.radius;
      if (distance2 >= reach * reach) {
        if (pairs.touching[p]) end_pair(chunk, i, p);
        if (shaped) pairs.clear[p] = std::sqrt(distance2) - reach;
        continue;
      }
      const auto number = static_cast<std::uint32_t>(p);
      const auto first = static_cast<std::uint32_t>(i), second = static_cast<std::uint32_t>(j);
      const auto place = shaped ? static_cast<std::int32_t>(scratch.shaped.size()) : -1;
      scratch.candidates.push_back({number, first, second, own_slot, place, separation});
      if (shaped) scratch.shaped.push_back({separation, first, second, number});
    }
  }
}

void DemSystem::Implementation::pairs_of(DemChunk& chunk, PairScratch& scratch, std::size_t c,
                                         std::size_t begin, std::size_t end, const StepTime& time) {
  find_candidates(chunk, scratch, c, begin, end, time.dt);
  if (!scratch.shaped.empty()) {
    scratch.geometry.assign(scratch.shaped.size(), {});
    scratch.outcome.resize(scratch.shaped.size());
    superquadric_pairs(turned_shapes, scratch.shaped, pairs.memory, scratch.geometry, scratch.outcome);
  }
  for (const Candidate& candidate : scratch.candidates) {
    Touch touch;
    const bool touches = candidate.shaped < 0 ? spheres_touch(candidate, touch)
                                              : superquadrics_touch(candidate, scratch, touch);
    if (touches)
      touch_pair(chunk, candidate, touch, time);
    else if (pairs.touching[candidate.pair])
      end_pair(chunk, candidate.i, candidate.pair);
  }
}

bool DemSystem::Implementation::spheres_touch(const Candidate& candidate, Touch& touch) const {
  const Body &a = bodies[candidate.i], &b = bodies[candidate.j];
  const double distance = candidate.separation.norm();
  touch.overlap = a.radius + b.radius - distance;
  touch.normal = distance > 0 ? Vec3(candidate.separation / distance) : Vec3(Vec3::UnitZ());
  touch.arm_a = (a.radius - 0.5 * touch.overlap) * touch.normal;
  touch.mass_effective = a.mass * b.mass / (a.mass + b.mass);
  return true;
}

bool DemSystem::Implementation::superquadrics_touch(const Candidate& candidate, const PairScratch& scratch,
                                                    Touch& touch) {
  const auto k = static_cast<std::size_t>(candidate.shaped);
  const ContactGeometry& geometry = scratch.geometry[k];
  if (scratch.outcome[k] == PairOutcome::separated || geometry.overlap <= 0) {
    // Most of the gap: the points are known to the solver's tolerance.
    constexpr double sure_part = 0.9;
    pairs.clear[candidate.pair] = -sure_part * geometry.overlap;
    return false;
  }
  touch.overlap = geometry.overlap;
  touch.normal = geometry.normal;
  touch.arm_a = geometry.point;
  touch.mass_effective = 1 / (yield(candidate.i, touch.arm_a, touch.normal) +
                              yield(candidate.j, touch.arm_a - candidate.separation, touch.normal));
  return true;
}

void DemSystem::Implementation::touch_pair(DemChunk& chunk, const Candidate& candidate, const Touch& touch,
                                           const StepTime& time) {
  const std::size_t i = candidate.i, j = candidate.j, p = candidate.pair;
  const Body &a = bodies[i], &b = bodies[j];
  note_overlap(chunk, a.size <= b.size ? i : j, 2 * touch.overlap / std::min(a.size, b.size), time);
  const ContactLaw& pair_law = law(a.material, b.material);
  const double k_n = limits.stiffness_per_size * 2 * a.size * b.size / (a.size + b.size);
  const ContactConstants constants =
      contact_constants(pair_law, k_n, config.tangential_ratio, touch.mass_effective, config.end_of_contact);
  const Vec3 &arm_a = touch.arm_a, arm_b = touch.arm_a - candidate.separation;
  const Vec3 velocity = a.v - b.v + a.w.cross(arm_a) - b.w.cross(arm_b);
  const ContactForce contact =
      contact_force(constants, touch.normal, touch.overlap, velocity, time.dt, pairs.spring[p]);
  Vec3 torque_a = arm_a.cross(contact.force), torque_b = arm_b.cross(-contact.force);
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
    torque_a += moment;
    torque_b -= moment;
    chunk.lost_friction -= moment.dot(spin) * time.dt;
  }
  pairs.touching[p] = 1;
  force[i] += contact.force;
  torque[i] += torque_a;
  if (candidate.slot == Candidate::no_slot) {
    force[j] -= contact.force;
    torque[j] += torque_b;
  } else {
    reactions[candidate.slot] = {-contact.force, torque_b};
  }
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
