#pragma once
/// Free rotation of a rigid body with its angular momentum held in the space frame.
///
/// The drift is split into turns about the body axes, x/2 y/2 z y/2 x/2 (Dullweber, Leimkuhler & McLachlan
/// 1997, J. Chem. Phys. 107:5840): symmetric, second order, and the momentum in space is not touched at all;
/// the energy error stays bounded. The angle of each turn is taken by Cayley's map, off by a third-order term
/// that depends on the momentum about that axis alone, so that all this holds without trigonometry.

#include <cmath>

#include "base/vec.h"

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

/// Turns q by a free motion of dt [s] with the angular momentum l [kg m2/s] of the space frame.
inline void rotate_freely(Quat& q, const Vec3& l, const Vec3& per_inertia, double dt) {
  Vec3 body = q.conjugate() * l;
  const auto turn = [&](int axis, double seconds) {
    const double quarter = 0.25 * seconds * body[axis] * per_inertia[axis];
    const double scale = 1 / (1 + quarter * quarter);
    const double c = (1 - quarter * quarter) * scale, s = 2 * quarter * scale;
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    auto& v = q.coeffs();  // x, y, z, w
    const double v_a = v[axis], v_j = v[j], v_k = v[k], w = v[3];
    v[axis] = c * v_a + s * w;
    v[j] = c * v_j + s * v_k;
    v[k] = c * v_k - s * v_j;
    v[3] = c * w - s * v_a;
    // The momentum seen from the body turns the other way.
    const double cos2 = c * c - s * s, sin2 = 2 * c * s;
    const double along_j = body[j], along_k = body[k];
    body[j] = cos2 * along_j + sin2 * along_k;
    body[k] = cos2 * along_k - sin2 * along_j;
  };
  turn(0, 0.5 * dt);
  turn(1, 0.5 * dt);
  turn(2, dt);
  turn(1, 0.5 * dt);
  turn(0, 0.5 * dt);
  q.normalize();
}

}  // namespace sluice
