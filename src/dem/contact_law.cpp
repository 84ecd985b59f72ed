#include "dem/contact_law.h"

#include <numbers>

#include "dem/linear_contact.h"

namespace sluice {

namespace {
constexpr double pi = std::numbers::pi;

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

ContactForce contact_force(const ContactConstants& c, const Vec3& n, double overlap, const Vec3& velocity,
                           double dt, Vec3& spring) {
  LinearContact<double> contact{{n.x(), n.y(), n.z()},
                                overlap,
                                {velocity.x(), velocity.y(), velocity.z()},
                                {spring.x(), spring.y(), spring.z()}};
  const LinearForce<double> f = linear_contact<double>(
      {c.k_n, c.k_t, c.c_n, c.c_t, c.friction, c.mass, c.end == EndOfContact::no_tension}, dt, contact);
  spring = {contact.spring.x, contact.spring.y, contact.spring.z};
  return {{f.force.x, f.force.y, f.force.z}, f.normal, f.lost_normal, f.lost_friction, f.elastic};
}

RollingConstants rolling_constants(double rolling, double radius_effective, double k_n, double inertia,
                                   double normal_force) {
  const RollingResistance<double> r =
      rolling_resistance(rolling, radius_effective, k_n, inertia, normal_force);
  return {r.stiffness, r.damping, r.limit};
}

Vec3 rolling_torque(const RollingConstants& c, const Vec3& spin, double dt, Vec3& turned) {
  lanes::Triple<double> held{turned.x(), turned.y(), turned.z()};
  const lanes::Triple<double> torque =
      rolling_moment<double>({c.stiffness, c.damping, c.limit}, {spin.x(), spin.y(), spin.z()}, dt, held);
  turned = {held.x, held.y, held.z};
  return {torque.x, torque.y, torque.z};
}

}  // namespace sluice
