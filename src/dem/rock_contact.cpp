#include <fmt/format.h>

#include <algorithm>

#include "base/errors.h"
#include "dem/dem_state.h"

namespace sluice {

void DemSystem::Implementation::check_overlap(DemChunk& chunk, std::size_t i, double ratio,
                                              const StepTime& time) const {
  if (!(ratio <= config.overlap_limit))
    throw NumericalError(
        "rocks.substeps", time.t,
        fmt::format("rock {} overlap is {:.3g} radius (limit {})", rocks.id[i], ratio, config.overlap_limit),
        plain_laws ? "raise 'impact_speed' or 'stiffness_per_size', or lower 'network_fraction'"
                   : "raise 'impact_speed', 'youngs_modulus' or 'stiffness_per_size', or lower 'adhesion'");
  chunk.overlap_most = std::max(chunk.overlap_most, ratio);
}

void DemSystem::Implementation::count_contact(DemChunk& chunk, double ratio, const StepTime& time) const {
  ++chunk.contacts;
  if (time.sampled) chunk.overlaps.push_back(ratio);
}

/// Acceleration along n of the contact point under a unit force along n [1/kg].
double DemSystem::Implementation::yield(std::size_t i, const Vec3& arm, const Vec3& n) const {
  const double by_mass = 1 / rocks.mass[i];
  if (is_sphere[static_cast<std::size_t>(rocks.shape[i])]) return by_mass;
  const Vec3 lever = rocks.q[i].conjugate() * arm.cross(n);
  return by_mass + lever.cwiseAbs2().dot(per_inertia[i]);
}

/// Whether two rocks that were some distance apart cannot have met in this step.
bool DemSystem::Implementation::keeps_clear(std::size_t p, std::size_t i, std::size_t j, double dt) {
  double& clear = pairs.clear[p];
  if (clear <= 0) return false;
  clear -= dt * ((rocks.v[i] - rocks.v[j]).norm() + rim_speed[i] + rim_speed[j]);
  return clear > 0;
}

void DemSystem::Implementation::find_candidates(DemChunk& chunk, PairScratch& scratch, std::size_t end,
                                                double dt) {
  scratch.shaped.clear();
  scratch.shaped_pairs.clear();
  if (only_spheres) return find_spheres(chunk, scratch, end);
  constexpr std::size_t ahead = 12;  // pairs: by then the second rock has come from memory
  const std::size_t begin = scratch.begin, last = pairs.start[end];
  scratch.spheres.make_room(last - pairs.start[begin]);
  for (std::size_t i = begin; i < end; ++i) {
    const RockPlaceRow a = places[i];
    for (std::size_t p = pairs.start[i]; p < pairs.start[i + 1]; ++p) {
      if (p + ahead < last) {
        const auto soon = static_cast<std::size_t>(pairs.second[p + ahead]);
        __builtin_prefetch(&places[soon]);
        __builtin_prefetch(&rocks.v[soon]);
      }
      const auto j = static_cast<std::size_t>(pairs.second[p]);
      const bool shaped = !(has_sphere_shape(rocks.shape[i]) && has_sphere_shape(rocks.shape[j]));
      if (shaped && keeps_clear(p, i, j, dt)) continue;
      const RockPlaceRow& b = places[j];
      Vec3 separation = b.x - a.x;
      if (periodic) separation = scene.domain.nearest_image(separation);
      const double distance2 = separation.squaredNorm(), reach = a.radius + b.radius;
      const bool meet = distance2 < reach * reach;
      if (!meet && pairs.touching[p]) end_pair(chunk, i, p);
      const Candidate candidate{separation, static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(i),
                                static_cast<std::uint32_t>(j)};
      if (!shaped) {
        if (meet) scratch.spheres.add(candidate, a.radius, b.radius);
      } else if (meet) {
        __builtin_prefetch(&pairs.memory[p]);
        __builtin_prefetch(&pairs.memory[p].normal.z());
        scratch.shaped.push_back(candidate);
        scratch.shaped_pairs.push_back(bodies_of(candidate));
      } else {
        pairs.clear[p] = std::sqrt(distance2) - reach;
      }
    }
  }
  scratch.spheres.repeat_last();
}

/// The bodies that stand for a pair's entry: the rocks, or a copy of one of them.
BodyPair DemSystem::Implementation::bodies_of(const Candidate& candidate) const {
  BodyPair pair{candidate.separation, candidate.i, candidate.j, candidate.pair};
  if (!meet_as_copies(candidate.i, candidate.j)) return pair;
  const std::uint32_t row = pairs.start[candidate.i];
  const auto first =
      std::lower_bound(pairs.second.begin() + row, pairs.second.begin() + pairs.start[candidate.i + 1],
                       static_cast<int>(candidate.j));
  const std::size_t copy = candidate.pair - static_cast<std::size_t>(first - pairs.second.begin());
  std::uint32_t& copied = is_copied(candidate.i, candidate.j) ? pair.a : pair.b;
  copied = static_cast<std::uint32_t>(copy_of(copied, copy));
  return pair;
}

/// Keeps of the pairs of superquadrics those that touch.
void DemSystem::Implementation::solve_shaped(DemChunk& chunk, PairScratch& scratch) {
  constexpr double sure_part = 0.9;  // of a gap: the points are known to the solver's tolerance
  scratch.geometry.assign(scratch.shaped.size(), {});
  scratch.outcome.resize(scratch.shaped.size());
  superquadric_pairs(turned_shapes, scratch.shaped_pairs, pairs.memory, scratch.geometry, scratch.outcome);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < scratch.shaped.size(); ++k) {
    const Candidate& candidate = scratch.shaped[k];
    const ContactGeometry& geometry = scratch.geometry[k];
    if (scratch.outcome[k] == PairOutcome::separated || geometry.overlap <= 0) {
      pairs.clear[candidate.pair] = -sure_part * geometry.overlap;
      if (pairs.touching[candidate.pair]) end_pair(chunk, candidate.i, candidate.pair);
      continue;
    }
    scratch.shaped[kept] = candidate;
    scratch.geometry[kept++] = geometry;
  }
  scratch.shaped.resize(kept);
  if (has_blocky) find_repeated(scratch);
}

/// Marks all touching copies of a pair but the deepest.
void DemSystem::Implementation::find_repeated(PairScratch& scratch) const {
  const std::vector<Candidate>& touching = scratch.shaped;
  scratch.repeated.assign(touching.size(), 1);
  for (std::size_t k = 0; k < touching.size();) {
    std::size_t deepest = k, next = k + 1;
    for (; next < touching.size() && touching[next].i == touching[k].i && touching[next].j == touching[k].j;
         ++next)
      if (scratch.geometry[next].overlap > scratch.geometry[deepest].overlap) deepest = next;
    scratch.repeated[deepest] = 0;
    k = next;
  }
}

void DemSystem::Implementation::pairs_of(DemChunk& chunk, PairScratch& scratch, std::size_t end,
                                         const StepTime& time) {
  find_candidates(chunk, scratch, end, time.dt);
  if (!scratch.shaped.empty()) solve_shaped(chunk, scratch);
  if (plain_laws) return touch_in_lanes(chunk, scratch, time);
  const auto ratio = [&](const Candidate& candidate, double overlap) {
    return 2 * overlap / std::min(rocks.size[candidate.i], rocks.size[candidate.j]);
  };
  for (std::size_t k = 0; k < scratch.spheres.count; ++k) {
    const Candidate candidate = scratch.spheres.candidate(k);
    const Touch touch = spheres_touch(candidate);
    touch_pair(chunk, candidate, touch, time);
    count_contact(chunk, ratio(candidate, touch.overlap), time);
  }
  for (std::size_t k = 0; k < scratch.shaped.size(); ++k) {
    const Candidate& candidate = scratch.shaped[k];
    const Touch touch = superquadrics_touch(candidate, scratch.geometry[k]);
    touch_pair(chunk, candidate, touch, time);
    if (has_blocky && scratch.repeated[k] != 0) continue;
    count_contact(chunk, ratio(candidate, touch.overlap), time);
  }
}

Touch DemSystem::Implementation::spheres_touch(const Candidate& candidate) const {
  const double radius_a = rocks.radius[candidate.i], radius_b = rocks.radius[candidate.j];
  const double mass_a = rocks.mass[candidate.i], mass_b = rocks.mass[candidate.j];
  const double distance = candidate.separation.norm();
  Touch touch;
  touch.overlap = radius_a + radius_b - distance;
  touch.normal = distance > 0 ? Vec3(candidate.separation / distance) : Vec3(Vec3::UnitZ());
  touch.arm_a = (radius_a - 0.5 * touch.overlap) * touch.normal;
  touch.mass_effective = mass_a * mass_b / (mass_a + mass_b);
  return touch;
}

Touch DemSystem::Implementation::superquadrics_touch(const Candidate& candidate,
                                                     const ContactGeometry& geometry) const {
  Touch touch;
  touch.overlap = geometry.overlap;
  touch.normal = geometry.normal;
  touch.arm_a = geometry.point;
  touch.mass_effective = 1 / (yield(candidate.i, touch.arm_a, touch.normal) +
                              yield(candidate.j, touch.arm_a - candidate.separation, touch.normal));
  return touch;
}

/// One contact on its own: what touch_in_lanes does for laws that lanes do not know.
void DemSystem::Implementation::touch_pair(DemChunk& chunk, const Candidate& candidate, const Touch& touch,
                                           const StepTime& time) {
  const std::size_t i = candidate.i, j = candidate.j, p = candidate.pair;
  const Body a = body_of(i), b = body_of(j);
  check_overlap(chunk, a.size <= b.size ? i : j, 2 * touch.overlap / std::min(a.size, b.size), time);
  const ContactLaw& pair_law = law(a.material, b.material);
  const double k_n = limits.stiffness_per_size * 2 * a.size * b.size / (a.size + b.size);
  const ContactConstants constants =
      contact_constants(pair_law, k_n, config.tangential_ratio, touch.mass_effective, config.end_of_contact);
  const Vec3 &arm_a = touch.arm_a, arm_b = touch.arm_a - candidate.separation;
  const Vec3 velocity = a.v - b.v + a.w.cross(arm_a) - b.w.cross(arm_b);
  const Indentation at{touch.overlap, 0.5 * a.size * b.size / (a.size + b.size), touch.mass_effective};
  const double share = share_of(i, j);
  const ContactForce contact = law_force(pair_law, constants, at, touch.normal, velocity, time.dt,
                                         {pairs.spring[p], pairs.rings_of(p)});
  const Vec3 force_a = share * contact.force;
  Vec3 torque_a = arm_a.cross(force_a), torque_b = arm_b.cross(-force_a);
  chunk.lost_normal += share * contact.lost_normal;
  chunk.lost_friction += share * contact.lost_friction;
  chunk.elastic += share * contact.elastic;

  if (has_rolling && pair_law.rolling > 0) {
    const double radius_a = 0.5 * a.size, radius_b = 0.5 * b.size;
    const double about_a = 1.4 * a.mass * radius_a * radius_a, about_b = 1.4 * b.mass * radius_b * radius_b;
    const RollingConstants rolling = rolling_constants(
        pair_law.rolling, radius_a * radius_b / (radius_a + radius_b), normal_stiffness(pair_law, k_n, at),
        about_a * about_b / (about_a + about_b), contact.normal);
    const Vec3 spin = a.w - b.w;
    const Vec3 moment = share * rolling_torque(rolling, spin, time.dt, pairs.turned[p]);
    torque_a += moment;
    torque_b -= moment;
    chunk.lost_friction -= moment.dot(spin) * time.dt;
  }
  pairs.touching[p] = 1;
  Push& on_a = push[i];
  on_a.force += force_a;
  on_a.torque += torque_a;
  Push& on_b = reaction_on(j, p);
  on_b.force -= force_a;
  on_b.torque += torque_b;
}

void DemSystem::Implementation::end_pair(DemChunk& chunk, std::size_t i, std::size_t p) {
  // A spring that is still stretched snaps back.
  const auto j = static_cast<std::size_t>(pairs.second[p]);
  const Body a = body_of(i), b = body_of(j);
  const double k_n = limits.stiffness_per_size * 2 * a.size * b.size / (a.size + b.size);
  const double k_spring = spring_stiffness(law(a.material, b.material), config.tangential_ratio * k_n,
                                           0.5 * a.size * b.size / (a.size + b.size));
  chunk.lost_friction += share_of(i, j) * 0.5 * k_spring * pairs.spring[p].squaredNorm();
  pairs.touching[p] = 0;
  pairs.spring[p].setZero();
  for (Vec3& stretch : pairs.rings_of(p)) stretch.setZero();
  if (has_rolling) pairs.turned[p].setZero();
}

}  // namespace sluice
