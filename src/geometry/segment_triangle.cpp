#include "geometry/segment_triangle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/exact_sign.h"
#include "geometry/surface_query.h"

namespace sluice {

namespace {

using Vec2 = Eigen::Vector2d;

int sign(double x) {
  return (x > 0) - (x < 0);
}

/// The plane's two axes in which the triangle is largest; nothing if it has no area.
std::optional<std::array<int, 2>> plane_axes(const Vec3& a, const Vec3& b, const Vec3& c) {
  int axis = 0;
  (b - a).cross(c - a).cwiseAbs().maxCoeff(&axis);
  // Tried in turn, since the rounded normal of a sliver may name a wrong axis.
  for (int k = 0; k < 3; ++k, axis = (axis + 1) % 3) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    if (orient2d({a[i], a[j]}, {b[i], b[j]}, {c[i], c[j]}) != 0) return std::array{i, j};
  }
  return std::nullopt;
}

/// Both ends lie in the triangle's plane.
std::optional<double> meets_in_plane(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b,
                                     const Vec3& c) {
  const auto axes = plane_axes(a, b, c);
  if (!axes) return std::nullopt;
  const auto flat = [&](const Vec3& x) { return Vec2(x[(*axes)[0]], x[(*axes)[1]]); };
  const Vec2 p = flat(from), q = flat(to);
  std::array<Vec2, 3> corner{flat(a), flat(b), flat(c)};
  if (orient2d(corner[0], corner[1], corner[2]) < 0) std::swap(corner[1], corner[2]);
  // Separated by the segment's line?
  int left = 0, right = 0;
  for (const Vec2& x : corner) {
    const int side = sign(orient2d(p, q, x));
    left += side > 0;
    right += side < 0;
  }
  if (left == 3 || right == 3) return std::nullopt;
  // Clipped by the three edges.
  double enter = 0, leave = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double from_edge = orient2d(corner[k], corner[(k + 1) % 3], p);
    const double to_edge = orient2d(corner[k], corner[(k + 1) % 3], q);
    if (from_edge < 0 && to_edge < 0) return std::nullopt;
    if (from_edge < 0) enter = std::max(enter, from_edge / (from_edge - to_edge));
    if (to_edge < 0) leave = std::min(leave, from_edge / (from_edge - to_edge));
  }
  constexpr double corner_rounding = 1e-14;  // a segment through a corner enters where it leaves
  return enter <= leave + corner_rounding ? std::optional(enter) : std::nullopt;
}

/// Sign of a directed edge against the segment whose end is moved by (e, e^2, e^3), e -> 0: simulation of
/// simplicity (Edelsbrunner & Muecke 1990). One movement for all triangles, so that shared edges and
/// vertices are passed on one side.
int side_of_edge(const Vec3& from, const Vec3& to, const Vec3& p, const Vec3& q) {
  const int exact = sign(orient3d(from, to, p, q));
  if (exact != 0) return exact;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const int turned = sign(orient2d({from[i], from[j]}, {p[i], p[j]}, {q[i], q[j]}));
    if (turned != 0) return turned;
  }
  return 0;  // the segment starts on the edge's line
}

}  // namespace

std::optional<double> segment_meets_triangle(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b,
                                             const Vec3& c) {
  const double at_from = orient3d(a, b, c, from), at_to = orient3d(a, b, c, to);
  if (sign(at_from) * sign(at_to) > 0) return std::nullopt;
  if (at_from == 0 && at_to == 0) return meets_in_plane(from, to, a, b, c);
  const int ab = sign(orient3d(from, to, a, b));
  const int bc = sign(orient3d(from, to, b, c));
  const int ca = sign(orient3d(from, to, c, a));
  if (std::min({ab, bc, ca}) < 0 && std::max({ab, bc, ca}) > 0) return std::nullopt;
  return at_from / (at_from - at_to);
}

bool segment_crosses_once(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double at_from = orient3d(a, b, c, from), at_to = orient3d(a, b, c, to);
  if ((at_from > 0) == (at_to > 0)) return false;
  const int ab = side_of_edge(from, to, a, b);
  const int bc = side_of_edge(from, to, b, c);
  const int ca = side_of_edge(from, to, c, a);
  return ab != 0 && ab == bc && bc == ca;
}

namespace {
/// Share of the way along an edge; 0 on an edge without length.
double share(double part, double whole) {
  return whole > 0 ? part / whole : 0.0;
}
}  // namespace

Vec3 closest_on_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ax = x - a;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3 bx = x - b;
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + share(d1, d1 - d3) * ab;
  const Vec3 cx = x - c;
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + share(d2, d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + share(d4 - d3, (d4 - d3) + (d5 - d6)) * (c - b);
  return a + ab * share(vb, va + vb + vc) + ac * share(vc, va + vb + vc);
}

}  // namespace sluice
