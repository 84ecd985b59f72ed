#pragma once
/// Force between elastic bodies that touch as two spheres of radius R1 and R2 do: Hertz along the normal,
/// Mindlin's no-slip stiffness across it, Coulomb's limit as in the linear law.
///
///   normal      F = 4/3 E* sqrt(R*) overlap^1.5 (Hertz; Johnson, Contact Mechanics, 1985), tangent
///               stiffness S = 2 E* sqrt(R* overlap)
///   dashpot     c_n = 2 sqrt(5/6) zeta sqrt(m S) (Tsuji, Tanaka & Ishida 1992, Powder Technol. 71:239).
///               With u = overlap^(5/4) and ds = overlap^(1/4) dt the law is the linear one in u
///               (Antypov & Elliott 2011, EPL 94:50004), force for force: so zeta is that of the linear
///               law for either end of the contact, and the restitution is that asked for at any speed.
///   across      k_t = 8 G* sqrt(R* overlap) (Mindlin & Deresiewicz 1953, J. Appl. Mech. 20:327), c_t =
///               sqrt(k_t / S) c_n. As the contact grows the force of the spring stays and only what is
///               added sees the new stiffness; as it shrinks the stretch stays and the force falls with
///               k_t (Thornton, Cummins & Cleary 2013, Powder Technol. 233:30). Either way the spring
///               loses energy, which counts as friction; kept as it was, it would make energy of nothing.
///               So much for `rescaled`. `whole_stretch` is the law of most published codes: force k_t times
///               all the stretch at any overlap; what that makes of nothing counts as negative friction.
///               `partial_slip` cuts the contact into rings that slip from the rim inwards (partial_slip.h).
///
/// R* = R1 R2 / (R1 + R2) with half the size of each rock, superquadrics too (their curvature at the
/// contact is not looked at: a flat face is stiffer, a tip softer); a wall has an infinite radius.

#include "dem/contact_law.h"
#include "dem/partial_slip.h"
#include "dem/sampled_dashpot.h"

namespace sluice {

/// 1 / E* = (1 - nu1^2) / E1 + (1 - nu2^2) / E2 [Pa]
double effective_modulus(const Material& a, const Material& b);
/// 1 / G* = (2 - nu1) / G1 + (2 - nu2) / G2, G = E / (2 (1 + nu)) [Pa]
double effective_shear_modulus(const Material& a, const Material& b);

/// Constants of the pair (a, b).
ContactLaw contact_law(const Materials& materials, int a, int b, EndOfContact end);

/// How two bodies touch.
struct Indentation {
  double overlap = 0;           ///< [m]
  double radius_effective = 0;  ///< [m]
  double mass_effective = 0;    ///< [kg]
};

/// dF/d overlap of Hertz's law [N/m].
inline double tangent_stiffness(const ContactLaw& law, const Indentation& at) {
  return 2 * law.modulus * std::sqrt(at.radius_effective * at.overlap);
}

/// Overlap that a mass [kg] arriving at `speed` [m/s] reaches under Hertz's law and a constant pull
/// [N], without damping [m].
double hertz_impact_overlap(double modulus, double radius_effective, double mass, double speed, double pull);
/// Duration of a damped Hertzian contact of that mass and speed [s]: 2.868 (m^2 / (R E^2 v))^(1/5)
/// without damping.
double hertz_contact_time(const ContactLaw& law, const Indentation& at, double speed, EndOfContact end);

/// Stiffness that turns what is kept of a tangential spring into its energy, 1/2 k |spring|^2 [N/m].
/// The linear law keeps the stretch. Hertz-Mindlin keeps the stretch times (overlap / R*)^(1/4), so
/// that the energy needs no overlap and a spring that snaps back loses what it really held; with rings,
/// what a single spring would be stretched that held as much as all of them.
inline double spring_stiffness(const ContactLaw& law, double linear_k_t, double radius_effective) {
  return law.force == ForceLaw::linear ? linear_k_t : law.shear_ratio * 2 * law.modulus * radius_effective;
}

/// Normal stiffness at this overlap, for rolling resistance [N/m].
inline double normal_stiffness(const ContactLaw& law, double linear_k_n, const Indentation& at) {
  return law.force == ForceLaw::linear ? linear_k_n : tangent_stiffness(law, at);
}

/// What a contact remembers of its shear.
struct ShearMemory {
  Vec3& spring;                ///< see spring_stiffness [m]
  std::span<Vec3> rings = {};  ///< shear_rings with partial_slip, else none [m]
};

/// Constants of the linear law that holds at this overlap.
inline ContactConstants hertz_mindlin_constants(const ContactLaw& law, const Indentation& at,
                                                EndOfContact end, double closing, double dt) {
  const double stiffness = tangent_stiffness(law, at);
  ContactConstants c;
  c.k_n = 2.0 / 3 * stiffness;  // secant
  c.k_t = law.shear_ratio * stiffness;
  c.c_n = 2 * std::sqrt(5.0 / 6) * law.zeta * std::sqrt(at.mass_effective * stiffness);
  c.c_t = std::sqrt(law.shear_ratio) * c.c_n;
  c.friction = law.friction;
  c.mass = at.mass_effective;
  c.end = end;
  // The sample of a first touch stands for a time in which the damping grows with overlap^(1/4).
  if (time_in_contact(at.overlap, closing, dt, end == EndOfContact::no_tension) < 1)
    c.c_n *= 0.8 * std::sqrt(std::sqrt(1 + 0.5 * std::abs(closing) * dt / at.overlap));
  return c;
}

/// One step under Hertz's law with the shear of partial_slip.h.
/// @param energy  of the springs over |spring|^2 [N/m]
/// @param growth  of the half width since the last step; infinite at first touch
inline ContactForce partial_slip_force(const ContactConstants& c, const Vec3& n, double overlap,
                                       const Vec3& velocity, double dt, double growth, double energy,
                                       const ShearMemory& memory) {
  ContactConstants smooth = c;
  smooth.friction = 0;
  Vec3 none = Vec3::Zero();
  ContactForce result = contact_force(smooth, n, overlap, velocity, dt, none);
  const double held = energy * memory.spring.squaredNorm(), limit = c.friction * std::max(0.0, result.normal);
  const Vec3 sliding = velocity - velocity.dot(n) * n;
  if (std::isfinite(growth))
    resize_rings(memory.rings, growth);
  else
    std::fill(memory.rings.begin(), memory.rings.end(), Vec3::Zero());
  const RingShear springs = shear(memory.rings, n, dt * sliding, c.k_t, limit);
  Vec3 across = springs.force - c.c_t * sliding;
  if (across.norm() > limit) across *= limit / across.norm();
  result.force += across;
  result.lost_friction = -across.dot(sliding) * dt - (springs.held - held);
  result.elastic += springs.held;
  memory.spring = -std::sqrt(springs.held / energy) * springs.force.stableNormalized();
  return result;
}

/// One step of a contact under Hertz-Mindlin; arguments as for `contact_force`.
/// @param memory  in and out
/// @pre at.overlap >= 0 [m]
inline ContactForce hertz_mindlin_force(const ContactLaw& law, const Indentation& at, EndOfContact end,
                                        const Vec3& n, const Vec3& velocity, double dt,
                                        const ShearMemory& memory) {
  Vec3& spring = memory.spring;
  const double energy = 0.5 * spring_stiffness(law, 0, at.radius_effective);
  const double held = energy * spring.squaredNorm();
  if (!(at.overlap > 0)) {
    spring.setZero();
    std::fill(memory.rings.begin(), memory.rings.end(), Vec3::Zero());
    ContactForce nothing;
    nothing.lost_friction = held;
    return nothing;
  }
  const double closing = velocity.dot(n);
  const ContactConstants c = hertz_mindlin_constants(law, at, end, closing, dt);
  const double before = std::max(0.0, at.overlap - closing * dt);  // of the last step
  const double not_half = 0.1 * c.k_n * at.overlap * at.overlap;   // 2/5 F overlap, not 1/2
  if (law.tangential == Tangential::partial_slip) {
    ContactForce result =
        partial_slip_force(c, n, at.overlap, velocity, dt, std::sqrt(at.overlap / before), energy, memory);
    result.elastic -= not_half;
    return result;
  }
  // The contact grew or shrank since: rescaled, the energy falls with the radius of the contact.
  const auto root = [&](double overlap) { return std::sqrt(std::sqrt(overlap / at.radius_effective)); };
  double kept = std::sqrt(std::min(at.overlap, before) / std::max(at.overlap, before));
  if (law.tangential == Tangential::whole_stretch) kept = before > 0 ? std::sqrt(at.overlap / before) : 0;
  Vec3 stretch = spring * (std::sqrt(kept) / root(at.overlap));
  ContactForce result = contact_force(c, n, at.overlap, velocity, dt, stretch);
  spring = root(at.overlap) * stretch;
  result.lost_friction += held * (1 - kept);
  result.elastic -= not_half;
  return result;
}

/// One step of a contact under the law of its materials.
/// @param linear  constants of the linear law for this contact
///
/// Adhesion is a constant pull F = adhesion R* while the bodies overlap: the largest force that they
/// can be drawn apart with. It is a potential, -F overlap, counted in `elastic`. Coulomb's limit and
/// rolling resistance go by the force without it, and so does the end of the dashpot's contact.
inline ContactForce law_force(const ContactLaw& law, const ContactConstants& linear, const Indentation& at,
                              const Vec3& n, const Vec3& velocity, double dt, const ShearMemory& memory) {
  ContactForce result = law.force == ForceLaw::linear
                            ? contact_force(linear, n, at.overlap, velocity, dt, memory.spring)
                            : hertz_mindlin_force(law, at, linear.end, n, velocity, dt, memory);
  if (law.adhesion > 0 && at.overlap > 0) {
    const double pull = law.adhesion * at.radius_effective;
    result.force += pull * n;
    result.elastic -= pull * at.overlap;
  }
  return result;
}

}  // namespace sluice
