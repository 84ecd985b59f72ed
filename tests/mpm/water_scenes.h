#pragma once
/// Small bodies of water for the tests.

#include <functional>
#include <memory>

#include "base/random.h"
#include "mpm/mpm_system.h"

namespace sluice {

inline Domain open_box(const Vec3& lo, const Vec3& hi) {
  Domain domain;
  domain.box.lo = lo;
  domain.box.hi = hi;
  return domain;
}

inline void make_periodic(Domain& domain, int axis) {
  domain.low[static_cast<std::size_t>(axis)] = domain.high[static_cast<std::size_t>(axis)] = Face::periodic;
}

/// Fills a box with points on a lattice, moved by up to `jitter` of their distance; compressed water (J < 1)
/// has more mass in the same space.
struct WaterFill {
  Box box;
  double jitter = 0;
  std::function<Vec3(const Vec3&)> velocity = [](const Vec3&) { return Vec3(Vec3::Zero()); };
  std::function<double(const Vec3&)> J = [](const Vec3&) { return 1.0; };
};

inline void fill_with_water(FluidSystem& water, double distance, const WaterFill& fill) {
  Random random(7);
  const Vec3 size = fill.box.size();
  const Vec3i n = (size / distance).array().round().cast<int>();
  const Vec3 step = size.array() / n.cast<double>().array();
  for (int k = 0; k < n.z(); ++k)
    for (int j = 0; j < n.y(); ++j)
      for (int i = 0; i < n.x(); ++i) {
        NewPoint p;
        p.x = fill.box.lo + Vec3((i + 0.5) * step.x(), (j + 0.5) * step.y(), (k + 0.5) * step.z());
        for (int r = 0; r < 3; ++r) p.x[r] += fill.jitter * step[r] * random.uniform(-1.0, 1.0);
        p.v = fill.velocity(p.x);
        p.J = fill.J(p.x);
        p.mass = water.model().density * step.prod() / p.J;
        water.add(p);
      }
}

inline void step_water(FluidSystem& water, double t, double dt) {
  water.points_to_grid(t, dt);
  water.walls(dt);
  water.grid_to_points(dt);
}

inline Vec3 angular_momentum(const FluidSystem& water) {
  const WaterPoints points = water.points();
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < points.count(); ++i) sum += points.mass[i] * points.x[i].cross(points.v[i]);
  return sum;
}

}  // namespace sluice
