#pragma once
/// The linear contact of contact_law.h for one contact (Real = double) or for several side by side (Real =
/// Lanes). No branches: what differs between lanes is selected. Conventions are those of contact_law.h.

#include "dem/lanes.h"
#include "dem/sampled_dashpot.h"

namespace sluice {

template <class Real>
struct LinearConstants {
  Real k_n, k_t;  ///< [N/m]
  Real c_n, c_t;  ///< [N s/m]
  Real friction;
  Real mass;  ///< effective [kg]
  bool no_tension;
};

template <class Real>
struct LinearContact {
  lanes::Triple<Real> n;         ///< from the first body to the second, unit
  Real overlap;                  ///< [m]
  lanes::Triple<Real> velocity;  ///< of the first relative to the second [m/s]
  lanes::Triple<Real> spring;    ///< tangential stretch [m]
};

template <class Real>
struct LinearForce {
  lanes::Triple<Real> force;        ///< on the first body [N]
  Real normal;                      ///< pushing apart [N]
  Real lost_normal, lost_friction;  ///< energy dissipated in this step [J]
  Real elastic;                     ///< held in both springs at the end of the step [J]
};

/// Turns a stretched spring into the plane across n and keeps its length.
template <class Real>
lanes::Triple<Real> turned_into_plane(const lanes::Triple<Real>& spring, const lanes::Triple<Real>& n) {
  const lanes::Triple<Real> across = spring - dot(spring, n) * n;
  const Real before = dot(spring, spring), after = dot(across, across);
  // A spring that lies along n has no direction left: it is let go.
  const auto has_direction = after > 0.0;
  const Real safe = lanes::select(has_direction, after, Real{} + 1.0);
  const Real stretch =
      lanes::select(has_direction, lanes::quick_root(before * lanes::reciprocal(safe)), Real{});
  return stretch * across;
}

/// One step of `dt` [s]; the spring is brought up to date.
template <class Real>
LinearForce<Real> linear_contact(const LinearConstants<Real>& c, double dt, LinearContact<Real>& contact) {
  using lanes::larger;
  using lanes::select;
  using lanes::Triple;
  const Triple<Real>& n = contact.n;
  LinearForce<Real> result;
  const Real closing = dot(contact.velocity, n);
  const Real from_spring = c.k_n * contact.overlap;
  const auto push = [&](const Real& damping) {
    const Real normal = from_spring + damping * closing;
    return c.no_tension ? larger(normal, Real{}) : normal;
  };
  const Real in_contact = time_in_contact<Real>(contact.overlap, closing, dt, c.no_tension);
  const auto touches = in_contact < 1.0;
  const Real normal = push(damping_in_contact<Real>(c.c_n, c.mass, dt));
  result.normal = normal;
  if (lanes::any(touches))
    result.normal = select(touches, push(damping_at_touch<Real>(c.c_n, c.mass, in_contact, dt)), normal);
  result.lost_normal = (result.normal - from_spring) * closing * dt;

  const Triple<Real> sliding = contact.velocity - closing * n;
  const Real held_before = 0.5 * c.k_t * dot(contact.spring, contact.spring);
  const Triple<Real> stretched = turned_into_plane(contact.spring, n) + (Real{} + dt) * sliding;
  const Triple<Real> elastic_and_damped = c.k_t * stretched + c.c_t * sliding;
  const Real size2 = dot(elastic_and_damped, elastic_and_damped);
  const Real limit = c.friction * larger(normal, Real{});
  const auto slides = size2 > limit * limit;
  const Real share = limit * lanes::reciprocal_root(select(slides, size2, Real{} + 1.0));
  Triple<Real> tangential = select(slides, share * elastic_and_damped, elastic_and_damped);
  // Cut back so that spring and dashpot together give the limit; no push, no stretch.
  const Real yields = select(limit > 0.0, lanes::reciprocal(c.k_t), Real{});
  contact.spring = select(slides, yields * (tangential - c.c_t * sliding), stretched);
  if (lanes::any(touches)) {
    const auto weighted = touches & (normal > 0.0);
    tangential =
        select(weighted, result.normal / select(weighted, normal, Real{} + 1.0), Real{} + 1.0) * tangential;
  }
  const Real held = 0.5 * c.k_t * dot(contact.spring, contact.spring);
  result.lost_friction = dot(tangential, sliding) * dt - (held - held_before);
  result.elastic = 0.5 * from_spring * contact.overlap + held;
  result.force = -result.normal * n - tangential;
  return result;
}

template <class Real>
struct RollingResistance {
  Real stiffness;  ///< [N m/rad]
  Real damping;    ///< [N m s/rad]
  Real limit;      ///< largest torque [N m]
};

/// See rolling_constants in contact_law.h.
template <class Real>
RollingResistance<Real> rolling_resistance(const Real& rolling, const Real& radius_effective, const Real& k_n,
                                           const Real& inertia, const Real& normal_force) {
  constexpr double damping_ratio = 0.3;  // Ai et al. (2011), their value for quasi-static beds
  const Real arm = rolling * radius_effective;
  const Real stiffness = 2.25 * k_n * arm * arm;
  return {stiffness, 2 * damping_ratio * lanes::quick_root(stiffness * inertia),
          arm * lanes::larger(normal_force, Real{})};
}

/// Torque on the first body [N m]; see rolling_torque in contact_law.h.
template <class Real>
lanes::Triple<Real> rolling_moment(const RollingResistance<Real>& c, const lanes::Triple<Real>& spin,
                                   double dt, lanes::Triple<Real>& turned) {
  using lanes::select;
  turned = turned + (Real{} + dt) * spin;
  lanes::Triple<Real> torque = c.stiffness * turned + c.damping * spin;
  const Real size2 = dot(torque, torque);
  const auto rolls = size2 > c.limit * c.limit;
  // Plastic: the spring alone may hold the limit, the dashpot adds nothing once it rolls.
  const Real held = c.stiffness * lanes::quick_root(dot(turned, turned));
  const auto yields = rolls & (held > c.limit);
  turned =
      select(yields, c.limit * lanes::reciprocal(select(yields, held, Real{} + 1.0)), Real{} + 1.0) * turned;
  const Real share =
      select(rolls, c.limit * lanes::reciprocal_root(select(rolls, size2, Real{} + 1.0)), Real{} + 1.0);
  return -share * torque;
}

}  // namespace sluice
