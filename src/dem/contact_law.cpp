#include "dem/contact_law.h"

#include <numbers>

namespace sluice {

namespace {
constexpr double pi = std::numbers::pi;
constexpr double rolling_damping_ratio = 0.3;  // Ai et al. (2011), their value for quasi-static beds

/// Restitution of a contact that ends where the force does (convention B).
double restitution_without_tension(double zeta) {
  if (zeta < 1) {
    const double angle = std::asin(zeta);
    return std::exp(-std::tan(angle) * (pi - 2 * angle));
  }
  if (zeta == 1) return std::exp(-2.0);
  return std::exp(-2 * zeta * std::acosh(zeta) / std::sqrt(zeta * zeta - 1));
}
}  // namespace

double damping_ratio(double restitution, EndOfContact end) {
  if (restitution >= 1) return 0;
  if (end == EndOfContact::tension) {
    const double log_e = std::log(restitution);
    return -log_e / std::sqrt(pi * pi + log_e * log_e);
  }
  // The restitution falls with zeta: bracket, then halve to the last bit.
  double low = 0, high = 1;
  while (restitution_without_tension(high) > restitution) high *= 2;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (restitution_without_tension(middle) > restitution ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double contact_phase(double zeta, EndOfContact end) {
  if (end == EndOfContact::tension) return pi / std::sqrt(std::max(1e-12, 1 - zeta * zeta));
  if (zeta < 1) {
    const double angle = std::asin(zeta);
    // (pi - 2 angle) / cos(angle) tends to 2 at zeta = 1
    return std::cos(angle) < 1e-6 ? 2 : (pi - 2 * angle) / std::cos(angle);
  }
  if (zeta == 1) return 2;
  return 2 * std::acosh(zeta) / std::sqrt(zeta * zeta - 1);
}

RollingConstants rolling_constants(double rolling, double radius_effective, double k_n, double inertia,
                                   double normal_force) {
  const double arm = rolling * radius_effective;
  const double stiffness = 2.25 * k_n * arm * arm;
  return {stiffness, 2 * rolling_damping_ratio * std::sqrt(stiffness * inertia),
          arm * std::max(0.0, normal_force)};
}

Vec3 rolling_torque(const RollingConstants& c, const Vec3& spin, double dt, Vec3& turned) {
  turned += spin * dt;
  Vec3 torque = c.stiffness * turned + c.damping * spin;
  const double size2 = torque.squaredNorm();
  if (size2 > c.limit * c.limit) {
    // Plastic: the spring alone may hold the limit, the dashpot adds nothing once it rolls.
    const double held = c.stiffness * turned.norm();
    if (held > c.limit) turned *= c.limit / held;
    torque *= c.limit / std::sqrt(size2);
  }
  return -torque;
}

}  // namespace sluice
