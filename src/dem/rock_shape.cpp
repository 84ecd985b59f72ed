#include "dem/rock_shape.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace sluice {

namespace {

RockShape make_shape(const Vec3& semi_axes, double m) {
  RockShape shape;
  shape.semi_axes = semi_axes;
  shape.blockiness = m;
  shape.volume = superquadric_volume(semi_axes, m);
  shape.inertia = superquadric_inertia(semi_axes, m);
  shape.bounding_radius = superquadric_bounding_radius(semi_axes, m);
  shape.surface = superquadric_area(semi_axes, m);
  shape.sphericity = std::cbrt(36 * std::numbers::pi * shape.volume * shape.volume) / shape.surface;
  return shape;
}

}  // namespace

RockShape make_sphere() {
  RockShape shape = make_shape(Vec3::Constant(0.5), 2);
  shape.surface = std::numbers::pi;
  shape.sphericity = 1;
  return shape;
}

RockShape make_superquadric(double elongation, double flatness, double blockiness) {
  assert(elongation >= 1 && flatness > 0 && flatness <= 1 && blockiness >= 2);
  if (elongation == 1 && flatness == 1 && blockiness == 2) return make_sphere();
  return make_shape(Vec3(0.5 * elongation, 0.5, 0.5 * flatness), blockiness);
}

double superquadric_volume(const Vec3& semi_axes, double m) {
  return 8 * semi_axes.prod() * std::pow(std::tgamma(1 + 1 / m), 3) / std::tgamma(1 + 3 / m);
}

Vec3 superquadric_inertia(const Vec3& semi_axes, double m) {
  const double kappa =
      std::tgamma(3 / m) * std::tgamma(1 + 3 / m) / (std::tgamma(1 / m) * std::tgamma(1 + 5 / m));
  const Vec3 square = semi_axes.cwiseAbs2();
  return kappa * (Vec3::Constant(square.sum()) - square);
}

double superquadric_bounding_radius(const Vec3& semi_axes, double m) {
  const double longest = semi_axes.maxCoeff();
  if (m <= 2) return longest;
  const double p = 2 * m / (m - 2);
  return longest * std::pow((semi_axes.array() / longest).pow(p).sum(), 1 / p);
}

double superquadric_function(const Vec3& semi_axes, double m, const Vec3& x_body) {
  return (x_body.array() / semi_axes.array()).abs().pow(m).sum();
}

Vec3 support_point(const Vec3& semi_axes, double m, const Vec3& n_body) {
  if (m == 2) {
    const Vec3 an = semi_axes.cwiseProduct(n_body);
    return semi_axes.cwiseProduct(an) / an.norm();
  }
  // With c = |a n| over its largest, the point is a sgn(n) c^(1/(m-1)) S^(-1/m), S = sum c^(m/(m-1)).
  const Vec3 an = semi_axes.cwiseProduct(n_body).cwiseAbs();
  const double largest = an.maxCoeff();
  const double exponent = 1 / (m - 1);
  Vec3 root;
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double c = an[k] / largest;
    root[k] = c == 1 ? 1 : std::pow(c, exponent);
    sum += c * root[k];
  }
  const double scale = std::pow(sum, -1 / m);
  Vec3 x;
  for (int k = 0; k < 3; ++k) x[k] = std::copysign(semi_axes[k] * root[k] * scale, n_body[k]);
  return x;
}

double support_height(const Vec3& semi_axes, double m, const Vec3& n_body) {
  if (m == 2) return semi_axes.cwiseProduct(n_body).norm();
  return n_body.dot(support_point(semi_axes, m, n_body));
}

}  // namespace sluice
