#include "dem/hertz_mindlin.h"

#include <numbers>

namespace sluice {

namespace {
constexpr double pi = std::numbers::pi;
constexpr double quadrature_reach = 3.2;  // tanh-sinh: beyond, weights are below 1e-16 of the largest
constexpr int quadrature_points = 40;     // on either side: 1e-13, checked against Beta(2/5, 1/2)

double shear_modulus(const Material& m) {
  return m.youngs_modulus / (2 * (1 + m.poissons_ratio));
}

/// Damped oscillator that starts at 0 with unit speed, undamped frequency 1.
double response(double zeta, double t) {
  const double decay = std::exp(-zeta * t), root = std::sqrt(std::abs(1 - zeta * zeta));
  if (root * t < 1e-8) return decay * t;
  return decay * (zeta < 1 ? std::sin(root * t) : std::sinh(root * t)) / root;
}

/// Integral of response^(-1/5) over the contact: its ends are weak poles, so tanh-sinh.
double hertz_phase(double zeta, EndOfContact end) {
  const double phase = contact_phase(zeta, end), h = quadrature_reach / quadrature_points;
  double sum = 0;
  for (int k = -quadrature_points; k <= quadrature_points; ++k) {
    const double t = k * h, s = 0.5 * pi * std::sinh(t);
    const double x = 1 / (1 + std::exp(-2 * s));  // (0, 1)
    const double weight = 0.25 * pi * std::cosh(t) / (std::cosh(s) * std::cosh(s));
    const double u = response(zeta, phase * x);
    if (u > 0) sum += weight * std::pow(u, -0.2);
  }
  return phase * h * sum;
}
}  // namespace

double effective_modulus(const Material& a, const Material& b) {
  return 1 / ((1 - a.poissons_ratio * a.poissons_ratio) / a.youngs_modulus +
              (1 - b.poissons_ratio * b.poissons_ratio) / b.youngs_modulus);
}

double effective_shear_modulus(const Material& a, const Material& b) {
  return 1 / ((2 - a.poissons_ratio) / shear_modulus(a) + (2 - b.poissons_ratio) / shear_modulus(b));
}

ContactLaw contact_law(const Materials& materials, int a, int b, EndOfContact end) {
  const PairProperties& pair = materials.pair(a, b);
  ContactLaw law;
  law.zeta = damping_ratio(pair.restitution, end);
  law.friction = pair.friction;
  law.rolling = pair.rolling;
  law.force = pair.law;
  law.tangential = pair.tangential;
  law.adhesion = pair.adhesion;
  if (pair.law == ForceLaw::hertz_mindlin) {
    const Material &first = materials.all[static_cast<std::size_t>(a)],
                   &second = materials.all[static_cast<std::size_t>(b)];
    law.modulus = effective_modulus(first, second);
    law.shear_ratio = 4 * effective_shear_modulus(first, second) / law.modulus;
  }
  return law;
}

double hertz_impact_overlap(double modulus, double radius_effective, double mass, double speed, double pull) {
  // 2/5 k x^(5/2) = energy + pull x: convex from the start value on, so Newton comes down to the root.
  const double k = 4.0 / 3 * modulus * std::sqrt(radius_effective);
  const double energy = 0.5 * mass * speed * speed;
  double x = std::pow(5 * energy / k, 0.4) + std::pow(5 * pull / k, 2.0 / 3);
  for (int i = 0; i < 100; ++i) {
    const double root = x * std::sqrt(x);
    const double step = (0.4 * k * root * x - energy - pull * x) / (k * root - pull);
    if (!(step > 1e-15 * x)) break;
    x -= step;
  }
  return x;
}

double hertz_contact_time(const ContactLaw& law, const Indentation& at, double speed, EndOfContact end) {
  // In u = overlap^(5/4) the motion is the linear one of frequency sqrt(5 k / 4 m); dt = ds / u^(1/5).
  const double k = 4.0 / 3 * law.modulus * std::sqrt(at.radius_effective);
  const double frequency = std::sqrt(1.25 * k / at.mass_effective);
  return hertz_phase(law.zeta, end) * std::pow(1.25 * speed / frequency, -0.2) / frequency;
}

}  // namespace sluice
