#pragma once
/// The dashpot of a contact, sampled once a step with the velocity of the middle of the step before.
///
/// Taken as it is, such a sample is wrong by a whole order. It sees a velocity that is half a step old; and
/// where the bodies met within the step, it stands for an interval that was not all contact. Both are
/// known beforehand, and a sample so weighted gives the restitution asked for with an error of the second
/// order in the step (validation/restitution). With y = c dt / m:
///
///   in contact   c / (1 + y/4): the lag of half a step adds y/2 to damping and stiffness alike; of the
///                ratio that restitution goes by, damping over the root of the stiffness, that is y/4
///   first touch  w c / (1 + w y/2), w = 1/2 + overlap / (closing dt): met that part of a step ago, the
///                sample stands for that time and the half step to come, in which the velocity falls
///   last touch   the same weight, where the dashpot pulls to the end; where it may not pull, the force has
///                come to zero before
///
/// Only damping changes: a contact at rest and one without damping are as they were. The force across the
/// normal is that of a step in contact, times what the normal force was changed by, so that Coulomb's limit
/// sees both alike and the spring does not remember the weight.

#include "dem/lanes.h"

namespace sluice {

/// Part of a step for which two bodies that met within it have been in contact; 1 where they met before.
/// @param closing  speed at which they approach [m/s]; negative where they part
template <class Real>
Real time_in_contact(const Real& overlap, const Real& closing, double dt, bool no_tension) {
  const Real closed = (no_tension ? closing : lanes::absolute(closing)) * dt;
  const auto met = overlap < closed;
  const Real safe = lanes::select(met, closed, Real{} + 1.0) + 1e-300;
  return lanes::select(met, overlap * lanes::reciprocal(safe), Real{} + 1.0);
}

/// Damping of a step in contact [N s/m].
/// @param c_n   of the law [N s/m]
/// @param mass  effective mass [kg]
template <class Real>
Real damping_in_contact(const Real& c_n, const Real& mass, double dt) {
  return c_n * mass * lanes::reciprocal(mass + 0.25 * c_n * dt);
}

/// Damping of the step of first or last touch [N s/m].
/// @param in_contact  see time_in_contact
template <class Real>
Real damping_at_touch(const Real& c_n, const Real& mass, const Real& in_contact, double dt) {
  const Real weighted = (0.5 + in_contact) * c_n;
  return weighted * mass * lanes::reciprocal(mass + 0.5 * weighted * dt);
}

}  // namespace sluice
