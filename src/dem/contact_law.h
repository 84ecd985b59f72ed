#pragma once
/// Force between two touching bodies: linear spring and dashpot along the normal, incremental spring
/// and dashpot with Coulomb's limit across it (Sinnott & Cleary 2017, eq. 1-2), rolling resistance.
/// The other laws (hertz_mindlin.h) set the constants of this one anew at every overlap.
///
/// Conventions: `n` points from the first body to the second; velocities are those of the first
/// relative to the second at the contact point; forces act on the first, their negative on the second.

#include <algorithm>
#include <cmath>

#include "base/vec.h"
#include "dem/materials.h"

namespace sluice {

/// What happens when the dashpot would pull the bodies together at the end of a contact.
enum class EndOfContact {
  no_tension,  ///< the normal force is cut off at zero
  tension,     ///< it may pull; the contact ends where the overlap does
};

/// Damping over critical damping that gives a normal restitution in (0, 1].
/// Schwager & Poeschel (2007) Granular Matter 9:465; Thornton, Cummins & Cleary (2013).
double damping_ratio(double restitution, EndOfContact end);
/// Duration of a contact times sqrt(k_n / m_eff).
double contact_phase(double damping_ratio, EndOfContact end);

/// Constants of one pair of materials.
struct ContactLaw {
  double zeta = 0;      ///< damping over critical damping
  double friction = 0;  ///< Coulomb coefficient
  double rolling = 0;   ///< rolling torque over R F_n
  ForceLaw force = ForceLaw::linear;
  Tangential tangential = Tangential::rescaled;
  double adhesion = 0;     ///< pull-off force over effective radius [N/m]
  double modulus = 0;      ///< E* of hertz_mindlin [Pa]
  double shear_ratio = 0;  ///< k_t over tangent normal stiffness of hertz_mindlin, 4 G* / E*
  bool plain() const { return force == ForceLaw::linear && adhesion == 0; }
};

/// Constants of one contact.
struct ContactConstants {
  double k_n = 0, k_t = 0;  ///< [N/m]
  double c_n = 0, c_t = 0;  ///< [N s/m]
  double friction = 0;
  double mass = 0;  ///< effective [kg], > 0
  EndOfContact end = EndOfContact::no_tension;
};

struct ContactForce {
  Vec3 force = Vec3::Zero();  ///< on the first body [N]
  double normal = 0;          ///< pushing apart, adhesion left out [N]
  double lost_normal = 0;     ///< energy dissipated in this step [J]
  double lost_friction = 0;   ///< [J]
  double elastic = 0;         ///< held in both springs at the end of the step [J]
};

inline ContactConstants contact_constants(const ContactLaw& law, double k_n, double tangential_ratio,
                                          double mass_effective, EndOfContact end) {
  const double c_n = 2 * law.zeta * std::sqrt(k_n * mass_effective);
  return {k_n,          tangential_ratio * k_n, c_n, std::sqrt(tangential_ratio) * c_n,
          law.friction, mass_effective,         end};
}

/// One step of a contact; see linear_contact in linear_contact.h, which does the same in lanes.
/// @param spring    tangential stretch [m], in and out
/// @param velocity  of the first body relative to the second [m/s]
/// @pre overlap >= 0 [m]
ContactForce contact_force(const ContactConstants& c, const Vec3& n, double overlap, const Vec3& velocity,
                           double dt, Vec3& spring);

/// Constants of rolling resistance in one contact.
struct RollingConstants {
  double stiffness = 0;  ///< [N m/rad]
  double damping = 0;    ///< [N m s/rad]
  double limit = 0;      ///< largest torque [N m]
};

/// Elastic-plastic spring and dashpot (Ai, Chen, Rotter & Ooi 2011, Powder Technol. 206:269, model C):
/// stiffness 2.25 k_n (mu_r R)^2, torque at most mu_r R F_n.
/// @param inertia  about the contact, of the pair [kg m2]
RollingConstants rolling_constants(double rolling, double radius_effective, double k_n, double inertia,
                                   double normal_force);

/// Torque on the first body [N m]; `turned` [rad] is in and out. Spinning about the normal is resisted
/// like rolling: a single point would otherwise let a flat rock spin on its face for ever.
/// @param spin  angular velocity of the first body relative to the second [rad/s]
Vec3 rolling_torque(const RollingConstants& c, const Vec3& spin, double dt, Vec3& turned);

}  // namespace sluice
