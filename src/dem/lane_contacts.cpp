/// The touching pairs of a chunk, as many side by side as the processor has lanes: rows of the rocks' arrays
/// are turned into lanes, one contact is evaluated in each, and forces go back to the rocks one lane after
/// the other, in the order of the list.

#include <algorithm>
#include <cstring>

#include "dem/dem_state.h"
#include "dem/lane_rows.h"
#include "dem/linear_contact.h"

namespace sluice {

namespace {

using lanes::all_lanes;
using lanes::any;
using lanes::kLanes;
using lanes::LaneIndices;
using lanes::LaneMask;
using lanes::Lanes;
using lanes::load_triples;
using lanes::select;
using LaneTriple = lanes::Triple<Lanes>;

/// Up to kLanes pairs; the last is repeated in lanes beyond `count`.
struct Group {
  std::size_t count;
  LaneMask real;  ///< lanes below count
  LaneIndices pair, i, j;
  LaneTriple separation;
};

LaneMask lanes_below(std::size_t count) {
  LaneMask real;
  for (std::size_t k = 0; k < kLanes; ++k) real[k] = k < count ? -1 : 0;
  return real;
}

Group gather(std::span<const Candidate> candidates) {
  Group g;
  g.count = std::min<std::size_t>(kLanes, candidates.size());
  g.real = lanes_below(g.count);
  lanes::Rows rows;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Candidate& candidate = candidates[std::min(k, g.count - 1)];
    g.pair[k] = candidate.pair;
    g.i[k] = candidate.i;
    g.j[k] = candidate.j;
    rows[k] = candidate.separation.data();
  }
  g.separation = load_triples(rows);
  return g;
}

Lanes lanes_at(const std::vector<double>& column, std::size_t first) {
  Lanes x;
  std::memcpy(&x, &column[first], sizeof x);
  return x;
}

Group gather(const MeetingSpheres& spheres, std::size_t first) {
  Group g;
  g.count = std::min<std::size_t>(kLanes, spheres.count - first);
  g.real = lanes_below(g.count);
  std::memcpy(g.pair.data(), &spheres.pair[first], sizeof g.pair);
  std::memcpy(g.i.data(), &spheres.i[first], sizeof g.i);
  std::memcpy(g.j.data(), &spheres.j[first], sizeof g.j);
  g.separation = {lanes_at(spheres.x, first), lanes_at(spheres.y, first), lanes_at(spheres.z, first)};
  return g;
}

/// What lanes know of one body each.
struct LaneMotion {
  LaneTriple v, w;
  Lanes mass, size;
};

LaneMotion load_motions(const std::vector<RockMotionRow>& motions, const LaneIndices& at) {
  static_assert(sizeof(RockMotionRow) == 8 * sizeof(double));
  lanes::Rows rows;
  for (std::size_t k = 0; k < kLanes; ++k) rows[k] = motions[at[k]].v.data();
  const lanes::Columns c = lanes::load_columns(rows);
  return {{c[0], c[1], c[2]}, {c[4], c[5], c[6]}, c[3], c[7]};
}

/// Where the bodies of each lane touch.
struct LaneTouch {
  LaneTriple normal, arm_a, arm_b;  ///< [m]
  Lanes overlap;                    ///< [m]
  Lanes mass_effective;             ///< [kg]
};

struct LaneLaw {
  Lanes zeta, friction, rolling;
};

/// Sums of the lanes, each lane its own.
struct LaneTallies {
  Lanes lost_normal{}, lost_friction{}, elastic{}, overlap_most{};
};

double sum_of(Lanes x) {
  double sum = 0;
  for (int k = 0; k < kLanes; ++k) sum += x[k];
  return sum;
}

/// Adds a force and a torque to one row a lane.
void add_rows(const LaneTriple& force, const LaneTriple& torque, const std::array<Push*, kLanes>& rows,
              std::size_t count) {
  const Lanes none{};
  alignas(64) std::array<std::array<double, 8>, kLanes> pushes;
  std::array<double*, kLanes> at;
  for (std::size_t k = 0; k < kLanes; ++k) at[k] = pushes[k].data();
  lanes::store_columns({force.x, force.y, force.z, none, torque.x, torque.y, torque.z, none}, at, kLanes);
  for (std::size_t k = 0; k < count; ++k) {
    double* row = rows[k]->force.data();
    for (std::size_t c = 0; c < 8; ++c) row[c] += pushes[k][c];
  }
}

static_assert(sizeof(Push) == 8 * sizeof(double));

/// Rotates into the frame of each lane's body.
LaneTriple to_body(const std::vector<TurnedShape>& shapes, const LaneIndices& at, const LaneTriple& x) {
  lanes::Rows rows;
  for (std::size_t k = 0; k < kLanes; ++k) rows[k] = shapes[at[k]].q.coeffs().data();
  const lanes::Columns q = lanes::load_columns(rows);
  const LaneTriple v{-q[0], -q[1], -q[2]};
  const LaneTriple t = all_lanes(2.0) * cross(v, x);
  return x + q[3] * t + cross(v, t);
}

}  // namespace

/// What the lanes share while a chunk's contacts are evaluated.
struct DemSystem::Implementation::LaneContacts {
  Implementation& s;
  DemChunk& chunk;
  PairScratch& scratch;
  const StepTime& time;
  LaneTallies tallies{};

  LaneLaw law_of(const Group& g) const {
    if (s.only_law != nullptr)
      return {all_lanes(s.only_law->zeta), all_lanes(s.only_law->friction), all_lanes(s.only_law->rolling)};
    LaneLaw law;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const ContactLaw& one = s.law(s.rocks.material[g.i[k]], s.rocks.material[g.j[k]]);
      law.zeta[k] = one.zeta;
      law.friction[k] = one.friction;
      law.rolling[k] = one.rolling;
    }
    return law;
  }

  LaneTouch spheres(const Group& g, std::size_t first, const Lanes& mass_a, const Lanes& mass_b) const {
    const Lanes radius_a = lanes_at(scratch.spheres.radius_i, first);
    const Lanes radius_b = lanes_at(scratch.spheres.radius_j, first);
    const Lanes distance2 = dot(g.separation, g.separation);
    const LaneMask apart = distance2 > 1e-290;
    const Lanes inverse = lanes::reciprocal_root(select(apart, distance2, all_lanes(1.0)));
    const Lanes distance = select(apart, distance2 * inverse, Lanes{});
    LaneTouch touch;
    touch.normal = select(apart, inverse * g.separation, LaneTriple{Lanes{}, Lanes{}, all_lanes(1.0)});
    touch.overlap = radius_a + radius_b - distance;
    touch.arm_a = (radius_a - 0.5 * touch.overlap) * touch.normal;
    touch.arm_b = touch.arm_a - g.separation;
    touch.mass_effective = mass_a * mass_b * lanes::reciprocal(mass_a + mass_b);
    return touch;
  }

  /// Acceleration along n of the contact point under a unit force along n [1/kg].
  Lanes yield(const LaneIndices& at, const Lanes& mass, const LaneTriple& arm, const LaneTriple& n) const {
    const LaneTriple lever = to_body(s.turned_shapes, at, cross(arm, n));
    const LaneTriple per_inertia = load_triples(s.per_inertia, at);
    return 1.0 / mass + lever.x * lever.x * per_inertia.x + lever.y * lever.y * per_inertia.y +
           lever.z * lever.z * per_inertia.z;
  }

  LaneTouch shaped(const Group& g, std::size_t first, const Lanes& mass_a, const Lanes& mass_b) const {
    LaneTouch touch;
    lanes::Rows points, normals;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const ContactGeometry& geometry = scratch.geometry[first + std::min(k, g.count - 1)];
      points[k] = geometry.point.data();
      normals[k] = geometry.normal.data();
      touch.overlap[k] = geometry.overlap;
    }
    touch.normal = load_triples(normals);
    touch.arm_a = load_triples(points);
    touch.arm_b = touch.arm_a - g.separation;
    touch.mass_effective =
        1.0 / (yield(g.i, mass_a, touch.arm_a, touch.normal) + yield(g.j, mass_b, touch.arm_b, touch.normal));
    return touch;
  }

  void note_overlaps(const Group& g, const LaneTouch& touch, const Lanes& size_a, const Lanes& size_b,
                     std::span<const std::uint8_t> repeated) {
    const Lanes ratio = 2.0 * touch.overlap * lanes::reciprocal(lanes::smaller(size_a, size_b));
    const LaneMask within = ratio <= s.config.overlap_limit;
    if (any(~within) || time.sampled || !repeated.empty()) {
      for (std::size_t k = 0; k < g.count; ++k) {
        s.check_overlap(chunk, size_a[k] <= size_b[k] ? g.i[k] : g.j[k], ratio[k], time);
        if (repeated.empty() || repeated[k] == 0) s.count_contact(chunk, ratio[k], time);
      }
      return;
    }
    tallies.overlap_most = lanes::larger(tallies.overlap_most, ratio);
    chunk.contacts += g.count;
  }

  /// What each lane's contact is of a whole one.
  Lanes share_of(const Group& g) const {
    Lanes share;
    for (std::size_t k = 0; k < kLanes; ++k) share[k] = s.share_of(g.i[k], g.j[k]);
    return share;
  }

  void give(const Group& g, const LaneTriple& force, const LaneTriple& torque_a, const LaneTriple& torque_b) {
    std::array<Push*, kLanes> on_a{}, on_b{};
    for (std::size_t k = 0; k < g.count; ++k) {
      on_a[k] = &s.push[g.i[k]];
      on_b[k] = &s.reaction_on(g.j[k], g.pair[k]);
      s.pairs.touching[g.pair[k]] = 1;
    }
    add_rows(force, torque_a, on_a, g.count);
    add_rows({-force.x, -force.y, -force.z}, torque_b, on_b, g.count);
  }

  static constexpr std::size_t ahead = 3 * kLanes;  ///< contacts: by then their rocks have come from memory

  /// Asks for what a group of spheres will need.
  void fetch(std::size_t first) const {
    if (first + kLanes > scratch.spheres.count) return;
    for (std::size_t k = first; k < first + kLanes; ++k) {
      __builtin_prefetch(&s.motions[scratch.spheres.j[k]]);
      __builtin_prefetch(&s.pairs.spring[scratch.spheres.pair[k]]);
    }
  }

  [[gnu::flatten]] void touch(std::size_t contacts, bool are_shaped) {
    for (std::size_t first = 0; first < contacts; first += kLanes) {
      const Group g = are_shaped ? gather(std::span<const Candidate>(scratch.shaped).subspan(first))
                                 : gather(scratch.spheres, first);
      if (!are_shaped) fetch(first + ahead);
      const LaneMotion a = load_motions(s.motions, g.i), b = load_motions(s.motions, g.j);
      const Lanes &mass_a = a.mass, &mass_b = b.mass, &size_a = a.size, &size_b = b.size;
      const LaneTouch touch =
          are_shaped ? shaped(g, first, mass_a, mass_b) : spheres(g, first, mass_a, mass_b);
      const bool copies = are_shaped && s.has_blocky;
      note_overlaps(g, touch, size_a, size_b,
                    copies ? std::span<const std::uint8_t>(scratch.repeated).subspan(first, g.count)
                           : std::span<const std::uint8_t>());

      // The law of the contact.
      const LaneLaw law = law_of(g);
      const double ratio = s.config.tangential_ratio;
      const Lanes k_n =
          s.limits.stiffness_per_size * 2 * size_a * size_b * lanes::reciprocal(size_a + size_b);
      const Lanes c_n = 2.0 * law.zeta * lanes::quick_root(k_n * touch.mass_effective);
      const LinearConstants<Lanes> constants{k_n,
                                             ratio * k_n,
                                             c_n,
                                             std::sqrt(ratio) * c_n,
                                             law.friction,
                                             touch.mass_effective,
                                             s.config.end_of_contact == EndOfContact::no_tension};
      const LaneTriple velocity = a.v - b.v + cross(a.w, touch.arm_a) - cross(b.w, touch.arm_b);
      LinearContact<Lanes> contact{touch.normal, touch.overlap, velocity,
                                   load_triples(s.pairs.spring, g.pair)};
      LinearForce<Lanes> f = linear_contact(constants, time.dt, contact);
      lanes::store_triples(contact.spring, s.pairs.spring, g.pair, g.count);

      LaneTriple torque_a = cross(touch.arm_a, f.force), torque_b = cross(f.force, touch.arm_b);
      Lanes lost_friction = f.lost_friction;
      if (s.has_rolling && any(law.rolling > 0.0)) {
        const Lanes radius_a = 0.5 * size_a, radius_b = 0.5 * size_b;
        const Lanes about_a = 1.4 * mass_a * radius_a * radius_a,
                    about_b = 1.4 * mass_b * radius_b * radius_b;
        const RollingResistance<Lanes> rolling =
            rolling_resistance<Lanes>(law.rolling, radius_a * radius_b / (radius_a + radius_b), k_n,
                                      about_a * about_b / (about_a + about_b), f.normal);
        const LaneTriple spin = a.w - b.w;
        LaneTriple turned = load_triples(s.pairs.turned, g.pair);
        const LaneTriple moment = rolling_moment(rolling, spin, time.dt, turned);
        lanes::store_triples(turned, s.pairs.turned, g.pair, g.count);
        torque_a = torque_a + moment;
        torque_b = torque_b - moment;
        lost_friction -= dot(moment, spin) * time.dt;
      }
      if (copies) {
        const Lanes share = share_of(g);
        f.force = share * f.force;
        torque_a = share * torque_a;
        torque_b = share * torque_b;
        f.lost_normal *= share;
        lost_friction *= share;
        f.elastic *= share;
      }
      give(g, f.force, torque_a, torque_b);
      tallies.lost_normal += select(g.real, f.lost_normal, Lanes{});
      tallies.lost_friction += select(g.real, lost_friction, Lanes{});
      tallies.elastic += select(g.real, f.elastic, Lanes{});
    }
  }
};

void DemSystem::Implementation::touch_in_lanes(DemChunk& chunk, PairScratch& scratch, const StepTime& time) {
  LaneContacts contacts{*this, chunk, scratch, time};
  contacts.touch(scratch.spheres.count, false);
  contacts.touch(scratch.shaped.size(), true);
  chunk.lost_normal += sum_of(contacts.tallies.lost_normal);
  chunk.lost_friction += sum_of(contacts.tallies.lost_friction);
  chunk.elastic += sum_of(contacts.tallies.elastic);
  for (int k = 0; k < kLanes; ++k)
    chunk.overlap_most = std::max(chunk.overlap_most, contacts.tallies.overlap_most[k]);
}

}  // namespace sluice
