#include "geometry/exact_sign.h"

#include <cmath>
#include <vector>

namespace sluice {

namespace {

constexpr double unit_roundoff = 1.1102230246251565e-16;                         // 2^-53
constexpr double orient3d_bound = (7.0 + 56.0 * unit_roundoff) * unit_roundoff;  // Shewchuk, o3derrboundA
constexpr double orient2d_bound = (3.0 + 16.0 * unit_roundoff) * unit_roundoff;  // ccwerrboundA

struct Pair {
  double high, low;  ///< high + low is the exact result
};

// Not inlined: a product that is contracted with the sum after it would not be the rounded product.
[[gnu::noinline]] Pair exact_product(double a, double b) {
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
}

Pair exact_sum(double a, double b) {
  const double x = a + b;
  const double b_virtual = x - a;
  const double a_virtual = x - b_virtual;
  return {x, (a - a_virtual) + (b - b_virtual)};
}

/// A sum of doubles that do not overlap, smallest first: an exact number.
using Expansion = std::vector<double>;

void add(Expansion& e, double b) {
  Expansion grown;
  grown.reserve(e.size() + 1);
  double q = b;
  for (double component : e) {
    const Pair s = exact_sum(q, component);
    if (s.low != 0) grown.push_back(s.low);
    q = s.high;
  }
  if (q != 0) grown.push_back(q);
  e = std::move(grown);
}

Expansion difference(double a, double b) {
  const Pair d = exact_sum(a, -b);
  Expansion e;
  if (d.low != 0) e.push_back(d.low);
  if (d.high != 0) e.push_back(d.high);
  return e;
}

/// Adds sign * e * f to the sum.
void add_product(Expansion& sum, const Expansion& e, const Expansion& f, double sign) {
  for (double x : e)
    for (double y : f) {
      const Pair p = exact_product(x, sign * y);
      add(sum, p.low);
      add(sum, p.high);
    }
}

/// The largest component carries the sign and, to rounding, the value.
double value_of(const Expansion& e) {
  double sum = 0;
  for (double x : e) sum += x;
  return e.empty() ? 0.0 : (sum == 0 ? e.back() : sum);
}

double orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Expansion u[3], v[3], w[3];
  for (int k = 0; k < 3; ++k) {
    u[k] = difference(b[k], a[k]);
    v[k] = difference(c[k], a[k]);
    w[k] = difference(d[k], a[k]);
  }
  Expansion det;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    Expansion minor;
    add_product(minor, v[i], w[j], 1);
    add_product(minor, v[j], w[i], -1);
    add_product(det, u[k], minor, 1);
  }
  return value_of(det);
}

}  // namespace

double orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  double det = 0, permanent = 0;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    det += u[k] * (v[i] * w[j] - v[j] * w[i]);
    permanent += std::abs(u[k]) * (std::abs(v[i] * w[j]) + std::abs(v[j] * w[i]));
  }
  return std::abs(det) > orient3d_bound * permanent ? det : orient3d_exact(a, b, c, d);
}

double orient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d u = b - a, v = c - a;
  const double left = u.x() * v.y(), right = u.y() * v.x();
  const double det = left - right;
  if (std::abs(det) > orient2d_bound * (std::abs(left) + std::abs(right))) return det;
  Expansion exact;
  add_product(exact, difference(b.x(), a.x()), difference(c.y(), a.y()), 1);
  add_product(exact, difference(b.y(), a.y()), difference(c.x(), a.x()), -1);
  return value_of(exact);
}

}  // namespace sluice
