/// Area of a superquadric and points spread over it.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dem/rock_shape.h"

namespace sluice {

namespace {

struct GaussRule {
  std::vector<double> x, weight;  ///< on [0, 1]
};

/// Gauss-Legendre nodes by Newton's method on the three-term recurrence.
GaussRule gauss_legendre(int n) {
  GaussRule rule;
  for (int i = 0; i < n; ++i) {
    double z = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    double slope = 1;
    for (int iteration = 0; iteration < 8; ++iteration) {
      double p = 1, below = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * z * p - (k - 1) * below) / k;
        below = p;
        p = next;
      }
      slope = n * (z * p - below) / (z * z - 1);
      z -= p / slope;
    }
    rule.x.push_back(0.5 * (1 - z));
    rule.weight.push_back(1 / ((1 - z * z) * slope * slope));
  }
  return rule;
}

/// Surface area per volume of the cone from the centre, over 3: |grad F| / (m) at the surface point of the
/// direction p (scaled frame, any length), times the cube of its distance scale r: dA = r^3 abc |g| dp.
double area_density(const Vec3& semi_axes, double m, const Vec3& p) {
  const double r = std::pow(p.array().abs().pow(m).sum(), -1 / m);
  const Vec3 g = (r * p.array().abs()).pow(m - 1) / semi_axes.array();
  return r * r * r * semi_axes.prod() * g.norm();
}

}  // namespace

double superquadric_area(const Vec3& semi_axes, double m) {
  // An octant in three pieces, each the part of the surface seen through one face of the unit cube.
  constexpr int kNodes = 48;  // 1e-10 at m = 2.5, 3e-9 at m = 32 (measured against 900 nodes)
  const GaussRule rule = gauss_legendre(kNodes);
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < kNodes; ++i)
      for (int j = 0; j < kNodes; ++j) {
        Vec3 p;
        p[axis] = 1;
        p[(axis + 1) % 3] = rule.x[static_cast<std::size_t>(i)];
        p[(axis + 2) % 3] = rule.x[static_cast<std::size_t>(j)];
        sum += rule.weight[static_cast<std::size_t>(i)] * rule.weight[static_cast<std::size_t>(j)] *
               area_density(semi_axes, m, p);
      }
  return 8 * sum;
}

std::vector<Vec3> surface_points(const Vec3& semi_axes, double m, int n) {
  if (n <= 0) return {};
  // Candidates: a Fibonacci spiral in the scaled frame, dense enough for aspect 4:1.
  const int candidates = 32 * n + 64;
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vec3> pool;
  for (int i = 0; i < candidates; ++i) {
    const double z = 1 - (2 * i + 1.0) / candidates;
    const double ring = std::sqrt(1 - z * z);
    const Vec3 p(ring * std::cos(golden * i), ring * std::sin(golden * i), z);
    pool.push_back(std::pow(p.array().abs().pow(m).sum(), -1 / m) * p.cwiseProduct(semi_axes));
  }
  std::vector<double> distance(pool.size(), std::numeric_limits<double>::infinity());
  std::vector<Vec3> chosen;
  std::size_t next = pool.size() / 2;
  while (static_cast<int>(chosen.size()) < n) {
    chosen.push_back(pool[next]);
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < pool.size(); ++i) {
      distance[i] = std::min(distance[i], (pool[i] - chosen.back()).squaredNorm());
      if (distance[i] > distance[farthest]) farthest = i;
    }
    next = farthest;
  }
  return chosen;
}

}  // namespace sluice
