#pragma once
/// Free rotation of a rigid body with its angular momentum held in the space frame.
///
/// The drift is split into turns about the body axes, x/2 y/2 z y/2 x/2 (Dullweber, Leimkuhler & McLachlan
/// 1997, J. Chem. Phys. 107:5840): symmetric, second order, and the momentum in space is not touched at all;
/// the energy error stays bounded. The angle of each turn is taken by Cayley's map, off by a third-order term
/// that depends on the momentum about that axis alone, so that all this holds without trigonometry.

#include <cmath>

#include "base/vec.h"
#include "dem/lanes.h"

namespace sluice {

/// Angular velocity in the space frame [rad/s].
/// @param l            angular momentum, space frame [kg m2/s]
/// @param per_inertia  one over the principal inertia, body frame [1/(kg m2)]
inline Vec3 angular_velocity(const Quat& q, const Vec3& l, const Vec3& per_inertia) {
  return q * Vec3((q.conjugate() * l).cwiseProduct(per_inertia));
}

inline Vec3 angular_momentum(const Quat& q, const Vec3& w, const Vec3& inertia) {
  return q * Vec3((q.conjugate() * w).cwiseProduct(inertia));
}

/// A unit quaternion and what stands beside it, for one body (Real = double) or for several side by side.
template <class Real>
struct Turn {
  lanes::Triple<Real> v;
  Real w;
};

template <class Real>
lanes::Triple<Real> turned(const Turn<Real>& q, const lanes::Triple<Real>& x) {
  const lanes::Triple<Real> t = (Real{} + 2.0) * cross(q.v, x);
  return x + q.w * t + cross(q.v, t);
}
template <class Real>
Turn<Real> back(const Turn<Real>& q) {
  return {{-q.v.x, -q.v.y, -q.v.z}, q.w};
}

/// As above, for bodies side by side.
template <class Real>
lanes::Triple<Real> angular_velocity(const Turn<Real>& q, const lanes::Triple<Real>& l,
                                     const lanes::Triple<Real>& per_inertia) {
  const lanes::Triple<Real> body = turned(back(q), l);
  return turned(q, {body.x * per_inertia.x, body.y * per_inertia.y, body.z * per_inertia.z});
}

/// One turn about body axis 0 of the cycle (0, 1, 2); `quarter` is a quarter of its angle.
template <class Real>
void turn_about(const Real& quarter, Real& v_a, Real& v_j, Real& v_k, Real& w, Real& along_j, Real& along_k) {
  const Real scale = lanes::reciprocal(1.0 + quarter * quarter);
  const Real c = (1.0 - quarter * quarter) * scale, s = 2.0 * quarter * scale;
  const Real old_a = v_a, old_j = v_j;
  v_a = c * old_a + s * w;
  w = c * w - s * old_a;
  v_j = c * old_j + s * v_k;
  v_k = c * v_k - s * old_j;
  // The momentum seen from the body turns the other way.
  const Real cos2 = c * c - s * s, sin2 = 2.0 * c * s, before = along_j;
  along_j = cos2 * before + sin2 * along_k;
  along_k = cos2 * along_k - sin2 * before;
}

/// Turns q by a free motion of dt [s] with the angular momentum l [kg m2/s] of the space frame.
template <class Real>
void rotate_freely(Turn<Real>& q, const lanes::Triple<Real>& l, const lanes::Triple<Real>& per_inertia,
                   double dt) {
  lanes::Triple<Real> body = turned(back(q), l);
  lanes::Triple<Real>& v = q.v;
  const auto about_x = [&](double seconds) {
    turn_about(0.25 * seconds * body.x * per_inertia.x, v.x, v.y, v.z, q.w, body.y, body.z);
  };
  const auto about_y = [&](double seconds) {
    turn_about(0.25 * seconds * body.y * per_inertia.y, v.y, v.z, v.x, q.w, body.z, body.x);
  };
  about_x(0.5 * dt);
  about_y(0.5 * dt);
  turn_about(0.25 * dt * body.z * per_inertia.z, v.z, v.x, v.y, q.w, body.x, body.y);
  about_y(0.5 * dt);
  about_x(0.5 * dt);
  const Real length = lanes::reciprocal_root(dot(v, v) + q.w * q.w);
  v = length * v;
  q.w *= length;
}

/// The same for one body.
inline void rotate_freely(Quat& q, const Vec3& l, const Vec3& per_inertia, double dt) {
  Turn<double> turn{{q.x(), q.y(), q.z()}, q.w()};
  rotate_freely<double>(turn, {l.x(), l.y(), l.z()}, {per_inertia.x(), per_inertia.y(), per_inertia.z()}, dt);
  q = Quat(turn.w, turn.v.x, turn.v.y, turn.v.z);
}

}  // namespace sluice
