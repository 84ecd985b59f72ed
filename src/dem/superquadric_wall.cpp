/// A superquadric against the parts of a wall: plane (closed form), line and point (the surface-point Newton
/// with the other body shrunk to a line or a point).

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "dem/rock_shape.h"
#include "dem/superquadric_contact.h"

namespace sluice {

namespace {

/// Predicted step over the least semi-axis below which the step is taken unchecked; see superquadric_contact.
constexpr double kStep = 1e-5;
constexpr double kResidual = 1e-6;
/// A line along a flat face leaves its point open; then residuals of this size suffice.
constexpr double kFlat = 1e-12;
constexpr int kIterations = 30;

/// p + t u in the body frame, u of length 1; a fixed point where `slides` is not set.
struct Line {
  Vec3 p = Vec3::Zero();
  Vec3 u = Vec3::Zero();
  bool slides = false;
};

struct Touch {
  Vec3 x = Vec3::Zero();  ///< surface point
  double t = 0;           ///< the line's point
  Vec3 normal = Vec3::Zero();
  double gap = 0;
};

/// Newton from touch.x and touch.t. Unknowns are the move dA of the surface point in its tangent plane E and
/// dt:  (1 + s W) dA - E'u dt = E'w,  (E'u)' W dA = -n.u,  w = p + t u - x, s = n.w.
/// The local maximum of the gap over all normals (over those across the line) is certified by
/// s > -1/max curvature, for a line s > -W11 / det W (W11 along the line).
bool find_touch(const Vec3& axes, double m, const Line& line, Touch& touch) {
  const double least = axes.minCoeff();
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const double guard = iteration < 10 ? 0.9 : 0.999;  // before the bound, as for pairs
    touch.x *= std::pow(superquadric_function(axes, m, touch.x), -1 / m);
    Vec3 g, h;
    for (int k = 0; k < 3; ++k) {
      const double u = std::fabs(touch.x[k] / axes[k]);
      const double power = m == 2 ? 1 : std::pow(u, m - 2);
      g[k] = power * touch.x[k] / (axes[k] * axes[k]);
      h[k] = (m - 1) * power / (axes[k] * axes[k]);
    }
    const double inverse = 1 / g.norm();
    const Vec3 n = g * inverse;
    h *= inverse;
    Vec3 e1 = line.u - line.u.dot(n) * n;
    const double along = e1.norm();
    const bool has_direction = line.slides && along > 1e-6;
    e1 = has_direction ? Vec3(e1 / along) : tangent_frame(n)[0];
    const Vec3 e2 = n.cross(e1);
    const double w11 = e1.dot(h.cwiseProduct(e1)) + 1e-13 / least;
    const double w12 = e1.dot(h.cwiseProduct(e2));
    const double w22 = e2.dot(h.cwiseProduct(e2)) + 1e-13 / least;
    const double det = w11 * w22 - w12 * w12;
    const Vec3 w = line.p + touch.t * line.u - touch.x;
    const double s = n.dot(w);
    const double wt1 = e1.dot(w), wt2 = e2.dot(w);
    const double tilt = has_direction ? n.dot(line.u) : 0;
    double bound, d1, d2, dt = 0;
    if (has_direction) {
      // Solved through the second equation first: W (1 + s W)^-1 stays finite where 1 + s W is singular.
      bound = w11 / std::max(det, 1e-300);
      const double se = std::max(s, -guard * bound);
      // Unknown dA from: row 2 of the first equation and the second equation.
      //   s w12 d1 + (1 + s w22) d2 = wt2;   along (w11 d1 + w12 d2) = -tilt
      const double m22 = 1 + se * w22;
      const double determinant = w11 * m22 - w12 * se * w12;  // w11 + s det W
      const double r = -tilt / along;
      d1 = (r * m22 - w12 * wt2) / determinant;
      d2 = (w11 * wt2 - se * w12 * r) / determinant;
      dt = ((1 + se * w11) * d1 + se * w12 * d2 - wt1) / along;
    } else {
      const double half = 0.5 * (w11 + w22);
      bound = 1 / (half + std::sqrt(std::max(half * half - det, 0.0)));
      const double se = std::max(s, -guard * bound);
      const double m11 = 1 + se * w11, m12 = se * w12, m22 = 1 + se * w22;
      const double determinant = m11 * m22 - m12 * m12;
      d1 = (m22 * wt1 - m12 * wt2) / determinant;
      d2 = (m11 * wt2 - m12 * wt1) / determinant;
    }
    const double step = std::hypot(d1, d2);
    const double miss = std::hypot(wt1, wt2);
    const double cap = step > 0.3 * least ? 0.3 * least / step : 1;
    const bool small_step = step < kStep * least && std::fabs(tilt) < kResidual && miss < kResidual * least;
    const bool flat = std::fabs(tilt) < kFlat && miss < kFlat * least;
    const bool done = (small_step || flat) && s > -bound;
    touch.x += cap * (d1 * e1 + d2 * e2);
    touch.t += cap * dt;
    if (done) {
      const double turn1 = w11 * d1 + w12 * d2, turn2 = w12 * d1 + w22 * d2;
      touch.normal = (n + turn1 * e1 + turn2 * e2).normalized();
      touch.gap = s;
      return true;
    }
  }
  return false;
}

/// The point of the line (or the fixed point) deepest in the ellipsoid of the same axes, and the surface
/// point on the ray through it.
Touch facing_touch(const Vec3& axes, const Line& line) {
  Touch touch;
  const Vec3 scaled_u = line.u.cwiseQuotient(axes);
  if (line.slides) touch.t = -scaled_u.dot(line.p.cwiseQuotient(axes)) / scaled_u.squaredNorm();
  touch.x = line.p + touch.t * line.u;
  if (touch.x.cwiseQuotient(axes).norm() < 1e-6) {
    // Through the centre: any way across the line.
    touch.x = line.slides ? tangent_frame(line.u)[0] : Vec3::UnitX();
  }
  return touch;
}

/// Newton from the support points of normals all around (across the line), the largest gap first.
Touch from_other_normals(const Vec3& axes, double m, const Line& line) {
  std::vector<std::pair<double, Vec3>> candidates;
  const auto add = [&](const Vec3& n) {
    candidates.emplace_back(n.dot(line.p) - support_height(axes, m, n), n);
  };
  if (line.slides) {
    constexpr int kAround = 72;
    const auto [e1, e2] = tangent_frame(line.u);
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * i / kAround;
      add(std::cos(angle) * e1 + std::sin(angle) * e2);
    }
  } else {
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j)
        for (int k = -2; k <= 2; ++k)
          if (i != 0 || j != 0 || k != 0) add(Vec3(i, j, k).normalized());
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& one, const auto& other) { return one.first > other.first; });
  for (const auto& [gap, n] : candidates) {
    Touch touch;
    touch.x = support_point(axes, m, n);
    touch.t = line.slides ? line.u.dot(touch.x - line.p) : 0;
    if (find_touch(axes, m, line, touch)) return touch;
  }
  // Never met in the tests; the best of the candidates is a contact of that normal, short of the optimum.
  const auto& [gap, n] = candidates.front();
  Touch best;
  best.x = support_point(axes, m, n);
  best.t = line.slides ? line.u.dot(best.x - line.p) : 0;
  best.normal = n;
  best.gap = gap;
  return best;
}

/// Warm, cold, then by continuation in m from the ellipsoid.
Touch resolve(const Vec3& axes, double m, const Line& line, const Vec3& start) {
  Touch touch = facing_touch(axes, line);
  const Touch cold = touch;
  if (start.squaredNorm() > 0) {
    touch.x = start;
    if (line.slides) touch.t = line.u.dot(start - line.p);
    if (find_touch(axes, m, line, touch)) return touch;
    touch = cold;
  }
  if (find_touch(axes, m, line, touch)) return touch;
  for (const double factor : {1.4, 1.15, 1.05}) {
    touch = cold;
    find_touch(axes, 2, line, touch);
    bool found = false;
    for (double now = 2; now < m;) {
      now = std::min(m, now * factor);
      found = find_touch(axes, now, line, touch);
    }
    if (found) return touch;
  }
  return from_other_normals(axes, m, line);
}

ContactGeometry in_space(const Superquadric& body, const Mat3& to_space, const Touch& touch,
                         const Vec3& other) {
  return {body.x + to_space * (0.5 * (touch.x + other)), to_space * touch.normal, -touch.gap};
}

}  // namespace

ContactGeometry superquadric_plane(const Superquadric& body, const Vec3& on_plane, const Vec3& n) {
  const Mat3 to_space = body.q.toRotationMatrix();
  const Vec3 lowest = body.x + to_space * support_point(body.semi_axes, body.m, to_space.transpose() * -n);
  const double gap = n.dot(lowest - on_plane);
  return {lowest - 0.5 * gap * n, -n, -gap};
}

bool superquadric_segment(const Superquadric& body, const Vec3& a, const Vec3& b, Vec3& start,
                          ContactGeometry& geometry) {
  const Mat3 to_space = body.q.toRotationMatrix();
  const double length = (b - a).norm();
  Line line;
  line.p = to_space.transpose() * (a - body.x);
  line.u = to_space.transpose() * ((b - a) / length);
  line.slides = true;
  // A line outside the ball about the body cannot touch it.
  const Vec3 foot = line.p - line.p.dot(line.u) * line.u;
  if (foot.squaredNorm() >= body.semi_axes.squaredNorm()) return false;
  const Touch touch = resolve(body.semi_axes, body.m, line, start);
  start = touch.x;
  if (touch.gap >= 0 || touch.t < 0 || touch.t > length) return false;
  geometry = in_space(body, to_space, touch, line.p + touch.t * line.u);
  return true;
}

bool superquadric_point(const Superquadric& body, const Vec3& p, Vec3& start, ContactGeometry& geometry) {
  const Mat3 to_space = body.q.toRotationMatrix();
  Line line;
  line.p = to_space.transpose() * (p - body.x);
  if (superquadric_function(body.semi_axes, body.m, line.p) >= 1) return false;
  const Touch touch = resolve(body.semi_axes, body.m, line, start);
  start = touch.x;
  geometry = in_space(body, to_space, touch, line.p);
  return true;
}

}  // namespace sluice
