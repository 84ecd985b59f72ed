#include "dem/superquadric_contact.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "dem/rock_shape.h"
#include "dem/superquadric_newton.h"

namespace sluice {

namespace {

using newton::Body;
using newton::Evaluation;
using newton::Triple;

Triple<double> triple(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
Vec3 vec3(const Triple<double>& t) {
  return {t.x, t.y, t.z};
}

/// How closely the last step must agree with the points before it may be taken unchecked.
struct Tolerance {
  double step;       ///< predicted step over the least semi-axis
  double residual;   ///< angle between the normals [rad]; tangential miss over the least semi-axis
  double sigma = 1;  ///< the certificate: gap > -sigma times the bound
};
/// The step taken last squares these: 1e-10 of the least semi-axis in the points, below 1e-12 in the overlap.
constexpr Tolerance kStep{1e-5, 1e-6};
constexpr Tolerance kTight{1e-8, 1e-8};
/// Two flat faces leave the points open along the faces; then normals that agree to this suffice (the overlap
/// is off by at most this times the face's half-width).
constexpr double kFlat = 1e-12;

/// Last resort, for overlaps within some percent of sigma, where the normal is all but undetermined and steps
/// become slow: measured 3 in 200000 pairs of m = 16, overlaps to 20 % of the least semi-axis.
constexpr Tolerance kNearSigma{1e-3, 1e-4, 1.01};

constexpr int kWarmIterations = 8;
constexpr int kColdIterations = 30;
constexpr int kFastIterations = 10;  ///< then the guard before sigma is lowered
constexpr double kLateGuard = 0.999;

/// A pair in the frame of A with the two surface points.
struct Frame {
  newton::Pair<double> pair;
  Triple<double> x, y;
};

enum class Progress { done, failed };

template <class PowerA, class PowerB>
Progress iterate(Frame& f, const Body<double, PowerA>& a, const Body<double, PowerB>& b, int limit,
                 const Tolerance& tolerance, Evaluation<double>& e) {
  const double least = f.pair.least;
  for (int iteration = 0; iteration < limit; ++iteration) {
    f.pair.guard = iteration < kFastIterations ? 0.9 : kLateGuard;
    e = newton::evaluate(f.pair, a, b, f.x, f.y);
    const double close = tolerance.residual * tolerance.residual, step = tolerance.step * tolerance.step;
    const bool small_step =
        e.step2 < step * least * least && e.angle2 < close && e.miss2 < close * least * least;
    const bool flat = e.angle2 < kFlat * kFlat && e.miss2 < kFlat * kFlat * least * least;
    if ((small_step || flat) && e.s > -tolerance.sigma * e.sigma && newton::faces(f.pair, e))
      return Progress::done;
    newton::advance(f.pair, e, f.x, f.y);
  }
  return Progress::failed;
}

bool whole(double m) {
  return m == std::floor(m) && m <= 17;
}

Progress iterate(Frame& f, const Superquadric& a, const Superquadric& b, double m_a, double m_b, int limit,
                 const Tolerance& tolerance, Evaluation<double>& e) {
  const Triple<double> inverse_a = triple(a.semi_axes.cwiseInverse());
  const Triple<double> inverse_b = triple(b.semi_axes.cwiseInverse());
  if (whole(m_a) && whole(m_b)) {
    const Body<double, newton::WholePower> body_a{inverse_a, {m_a, static_cast<std::uint32_t>(m_a) - 2}};
    const Body<double, newton::WholePower> body_b{inverse_b, {m_b, static_cast<std::uint32_t>(m_b) - 2}};
    return iterate(f, body_a, body_b, limit, tolerance, e);
  }
  const Body<double, newton::AnyPower> body_a{inverse_a, {m_a}};
  const Body<double, newton::AnyPower> body_b{inverse_b, {m_b}};
  return iterate(f, body_a, body_b, limit, tolerance, e);
}

/// Cold start: the points of both surfaces that lie towards the other centre.
void facing_points(Frame& f) {
  const Vec3 d = vec3(f.pair.d);
  const Vec3 towards = d.squaredNorm() > 0 ? d : Vec3::UnitX();
  f.x = triple(towards);
  f.y = f.pair.rotation.back(triple(-towards));
}

/// From the ellipsoids of the same axes to the shapes, m growing by `factor`.
Progress continue_in_m(Frame& f, const Superquadric& a, const Superquadric& b, double factor,
                       const Tolerance& tolerance, Evaluation<double>& e) {
  facing_points(f);
  double m_a = 2, m_b = 2;
  iterate(f, a, b, m_a, m_b, kColdIterations, kStep, e);
  Progress progress = Progress::failed;
  while (m_a < a.m || m_b < b.m) {
    m_a = std::min(a.m, m_a * factor);
    m_b = std::min(b.m, m_b * factor);
    const bool last = m_a == a.m && m_b == b.m;
    progress = iterate(f, a, b, m_a, m_b, kColdIterations, last ? tolerance : kStep, e);
  }
  return progress;
}

/// From the support points along the normals at which boxes of the same axes can touch (the faces of both and
/// the cross products of their edges), the one with the largest gap first.
template <class Gap>
Progress try_box_normals(Frame& f, const Superquadric& a, const Superquadric& b, const Mat3& rotation,
                         const Gap& gap_along, const Tolerance& tolerance, Evaluation<double>& e) {
  std::vector<std::pair<double, Vec3>> candidates;
  const auto add = [&](const Vec3& direction) {
    if (direction.squaredNorm() < 1e-12) return;
    Vec3 n = direction.normalized();
    if (n.dot(vec3(f.pair.d)) < 0) n = -n;
    candidates.emplace_back(gap_along(n), n);
  };
  add(vec3(f.pair.d));
  for (int i = 0; i < 3; ++i) {
    add(Vec3::Unit(i));
    add(rotation.col(i));
    for (int j = 0; j < 3; ++j) add(Vec3::Unit(i).cross(rotation.col(j)));
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& one, const auto& other) { return one.first > other.first; });
  for (const auto& [gap, n] : candidates) {
    f.x = triple(support_point(a.semi_axes, a.m, n));
    f.y = triple(support_point(b.semi_axes, b.m, -(rotation.transpose() * n)));
    if (iterate(f, a, b, a.m, b.m, kColdIterations, tolerance, e) == Progress::done) return Progress::done;
  }
  return Progress::failed;
}

bool is_sphere(const Superquadric& body) {
  return body.m == 2 && body.semi_axes.x() == body.semi_axes.y() && body.semi_axes.y() == body.semi_axes.z();
}

PairOutcome sphere_pair(const Superquadric& a, const Superquadric& b, PairMemory& memory,
                        ContactGeometry& geometry) {
  const Vec3 d = b.x - a.x;
  const double distance = d.norm();
  geometry.normal = distance > 0 ? Vec3(d / distance) : Vec3::UnitZ();
  geometry.overlap = a.semi_axes.x() + b.semi_axes.x() - distance;
  geometry.point = a.x + (a.semi_axes.x() - 0.5 * geometry.overlap) * geometry.normal;
  memory.normal = geometry.normal;
  return PairOutcome::converged;
}

/// The last step, to first order, and back to the space frame.
void finish(Frame& f, const Evaluation<double>& e, const Superquadric& a, const Mat3& to_space,
            PairMemory& memory, ContactGeometry& geometry) {
  newton::advance(f.pair, e, f.x, f.y);
  const Vec3 x = vec3(f.x);
  const Vec3 y = vec3(f.pair.rotation.forth(f.y)) + vec3(f.pair.d);
  const Vec3 n = (vec3(e.n) + e.turn1 * vec3(e.e1) + e.turn2 * vec3(e.e2)).normalized();
  geometry.normal = to_space * n;
  geometry.overlap = -e.s;
  geometry.point = a.x + to_space * (0.5 * (x + y));
  memory.surface_a = x;
  memory.surface_b = vec3(f.y);
  memory.normal = geometry.normal;
}

enum class Test { separation, none };

PairOutcome solve(const Superquadric& a, const Superquadric& b, const Tolerance& tolerance, Test test,
                  PairMemory& memory, ContactGeometry& geometry) {
  const Mat3 to_space = a.q.toRotationMatrix();
  const Mat3 b_to_space = b.q.toRotationMatrix();
  Frame f;
  const Vec3 d = to_space.transpose() * (b.x - a.x);
  const Mat3 rotation = to_space.transpose() * b_to_space;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) f.pair.rotation.m[i][j] = rotation(i, j);
  f.pair.d = triple(d);
  f.pair.least = std::min(a.semi_axes.minCoeff(), b.semi_axes.minCoeff());

  const bool warm = memory.normal.squaredNorm() > 0 && memory.surface_a.squaredNorm() > 0;
  const auto gap_along = [&](const Vec3& n) {
    return n.dot(d) - support_height(a.semi_axes, a.m, n) -
           support_height(b.semi_axes, b.m, -(rotation.transpose() * n));
  };
  if (test == Test::separation) {
    const Vec3 n = warm ? Vec3(to_space.transpose() * memory.normal) : Vec3(d.normalized());
    // The points known bound the gap along n from above: no need to look where they already overlap.
    const bool may = !warm || n.dot(d + rotation * memory.surface_b - memory.surface_a) > 0;
    const double gap = may ? gap_along(n) : 0;
    if (gap > 0) {
      geometry.overlap = -gap;
      return PairOutcome::separated;
    }
  }

  Evaluation<double> e;
  PairOutcome outcome = PairOutcome::converged;
  Progress progress = Progress::failed;
  if (warm) {
    f.x = triple(memory.surface_a);
    f.y = triple(memory.surface_b);
    progress = iterate(f, a, b, a.m, b.m, kWarmIterations, tolerance, e);
  }
  if (progress == Progress::failed) {
    facing_points(f);
    progress = iterate(f, a, b, a.m, b.m, kColdIterations, tolerance, e);
  }
  for (const double factor : {1.4, 1.1}) {
    if (progress == Progress::done) break;
    outcome = PairOutcome::fallback;
    progress = continue_in_m(f, a, b, factor, tolerance, e);
  }
  if (progress == Progress::failed) progress = try_box_normals(f, a, b, rotation, gap_along, tolerance, e);
  if (progress == Progress::failed) progress = continue_in_m(f, a, b, 1.1, kNearSigma, e);
  if (progress == Progress::failed) outcome = PairOutcome::unresolved;
  finish(f, e, a, to_space, memory, geometry);
  return outcome;
}

}  // namespace

PairOutcome superquadric_pair(const Superquadric& a, const Superquadric& b, PairMemory& memory,
                              ContactGeometry& geometry) {
  const PairOutcome outcome = is_sphere(a) && is_sphere(b)
                                  ? sphere_pair(a, b, memory, geometry)
                                  : solve(a, b, kStep, Test::separation, memory, geometry);
  const bool gap = outcome != PairOutcome::unresolved && geometry.overlap <= 0;
  return outcome == PairOutcome::separated || gap ? PairOutcome::separated : outcome;
}

PairOutcome superquadric_gap(const Superquadric& a, const Superquadric& b, PairMemory& memory,
                             ContactGeometry& geometry) {
  if (is_sphere(a) && is_sphere(b)) return sphere_pair(a, b, memory, geometry);
  return solve(a, b, kTight, Test::none, memory, geometry);
}

}  // namespace sluice
