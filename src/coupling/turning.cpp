#include "coupling/turning.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sluice {

namespace {

using std::numbers::pi;

constexpr double cross_flow = 1.2;  ///< Cd of long strips and cylinders broadside, Re 1e3 to 1e5
constexpr double inertial_from = 32;

// Integrals over l = 0..oo of 1 / ((a_i^2 + l) sqrt((a^2 + l)(b^2 + l)(c^2 + l))); with l = c^2 (1/t^2 - 1)
// they are of a smooth function over 0 < t < 1, so that the midpoint rule's error falls with 1/n^2.
Vec3 ellipsoid_integrals(const Vec3& a) {
  constexpr int n = 4096;
  const double least = a.minCoeff() * a.minCoeff();
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < n; ++i) {
    const double t = (i + 0.5) / n, l = least * (1 / (t * t) - 1);
    const Vec3 at = a.cwiseAbs2() + Vec3::Constant(l);
    sum += 2 * least / (t * t * t * std::sqrt(at.prod()) * n) * at.cwiseInverse();
  }
  return sum;
}

double inertial_factor(double re) {
  return re <= inertial_from ? 1 : std::max(1.0, (12.9 * std::sqrt(re) + 128.4) / (64 * pi));
}

}  // namespace

Turning::Turning(const RockShape& shape) : semi_axes_(shape.semi_axes) {
  const Vec3 &a = semi_axes_, square = a.cwiseAbs2(), integral = ellipsoid_integrals(a);
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    reach_[k] = -std::expm1(3 * (1 - a[k] / a.minCoeff()));
    creeping_[k] =
        16 * pi * (square[i] + square[j]) / (3 * (square[i] * integral[i] + square[j] * integral[j]));
    edges_[k] = a[k] * std::abs(square[i] * square[i] - square[j] * square[j]);
  }
}

Vec3 Turning::centre_of_pressure(const TurningInput& in) const {
  const double most = reach_.maxCoeff();
  if (!(most > 0)) return Vec3::Zero();
  const double along = reach_.dot(in.direction.cwiseAbs2()) / most;
  return -0.5 * in.size * along * semi_axes_.cwiseProduct(reach_).cwiseProduct(in.direction);
}

Vec3 Turning::resistance(const TurningInput& in) const {
  Vec3 out;
  for (int k = 0; k < 3; ++k) {
    const double widest = in.size * std::max(semi_axes_[(k + 1) % 3], semi_axes_[(k + 2) % 3]);
    const double speed = std::abs(in.spin[k]);
    const double re = in.density * 4 * widest * widest * speed / in.viscosity;
    out[k] = in.viscosity * std::pow(in.size, 3) * creeping_[k] * inertial_factor(re) +
             0.5 * in.density * cross_flow * std::pow(in.size, 5) * edges_[k] * speed;
  }
  return out;
}

}  // namespace sluice
