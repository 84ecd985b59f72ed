#include "mpm/round_body.h"

#include <algorithm>
#include <cmath>

namespace sluice {

namespace {
constexpr int steps_to_surface = 3;

}  // namespace

bool BodyFace::hides(const Vec3& p, const Vec3& q) const {
  const double start = over(p), end = over(q);
  if (end < 0) return start >= 0 || end < start;  // from within, only what lies deeper
  if (start < 0) return false;
  // Along the way the height is a parabola.
  const double bend = 0.5 * curvature * (q - p).squaredNorm(), slope = end - start - bend;
  if (slope >= 0 || -slope >= 2 * bend) return false;
  return start - slope * slope / (4 * bend) < 0;
}

double RoundBody::gauge(const Vec3& x) const {
  if (m == 2) return x.cwiseQuotient(semi_axes).norm();
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += std::pow(std::abs(x[k] / semi_axes[k]), m);
  return std::pow(sum, 1 / m);
}

Vec3 RoundBody::gauge_gradient(const Vec3& x) const {
  const double f = gauge(x);
  if (!(f > 0)) return Vec3::Zero();
  if (m == 2) return x.cwiseQuotient(semi_axes.cwiseProduct(semi_axes)) / f;
  Vec3 gradient;
  for (int k = 0; k < 3; ++k) {
    const double u = x[k] / (f * semi_axes[k]);
    gradient[k] = std::copysign(std::pow(std::abs(u), m - 1), u) / semi_axes[k];
  }
  return gradient;
}

double RoundBody::about(const Vec3& x) const {
  const Vec3 rest = pose.to_rest(x);
  const double slope = gauge_gradient(rest).norm();
  return slope > 0 ? (gauge(rest) - 1) / slope : -semi_axes.minCoeff();
}

Vec3 RoundBody::on_surface(const Vec3& rest) const {
  Vec3 x = rest;
  if (!(gauge(x) > 0)) x = Vec3(0, 0, semi_axes[2]);
  if (!is_ball())
    for (int i = 0; i < steps_to_surface; ++i) {
      const Vec3 gradient = gauge_gradient(x);
      x -= (gauge(x) - 1) / gradient.squaredNorm() * gradient;
    }
  return x / gauge(x);
}

BodyFace RoundBody::face(const Vec3& x, double sharpest) const {
  const Vec3 rest = pose.to_rest(x);
  const Vec3 foot = on_surface(rest), gradient = gauge_gradient(foot);
  const double slope = gradient.norm();
  BodyFace face;
  const Vec3 normal = gradient / slope;
  face.height = (rest - foot).dot(normal);
  if (is_ball()) {
    face.curvature = 1 / semi_axes[0];
  } else {
    Vec3 bend;
    for (int k = 0; k < 3; ++k)
      bend[k] = (m - 1) * std::pow(std::abs(foot[k] / semi_axes[k]), m - 2) / (semi_axes[k] * semi_axes[k]);
    face.curvature = (bend.sum() - normal.dot(bend.cwiseProduct(normal))) / (2 * slope);
  }
  face.curvature = std::min(face.curvature, sharpest);
  face.normal = pose.q * normal;
  face.foot = pose.to_space(foot);
  return face;
}

}  // namespace sluice
