/// What no step may do: make energy. Walls at rest and gravity leave kinetic plus potential energy as it is
/// or take from it.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "mpm/water_scenes.h"

namespace sluice {
namespace {

const Vec3 gravity(0, 0, -9.81);

Wall rectangle(const std::string& name, const std::array<Vec3, 4>& corners) {
  Wall wall;
  wall.name = name;
  wall.mesh = make_rectangle(name, corners);
  return wall;
}

double energy(const FluidSystem& water) {
  const WaterPoints points = water.points();
  double sum = 0;
  for (std::size_t i = 0; i < points.count(); ++i)
    sum += points.mass[i] * (0.5 * points.v[i].squaredNorm() - gravity.dot(points.x[i]));
  return sum;
}

/// Scattered points at `speed` in a fan of +-`half_angle` about `direction`; `per_cell` on average.
void add_spray(FluidSystem& water, const Box& box, double h, double per_cell, const Vec3& direction,
               double speed, double half_angle) {
  Random random(3);
  const int count = static_cast<int>(per_cell * box.size().prod() / (h * h * h));
  const Vec3 ahead = direction.normalized();
  const Vec3 side = ahead.unitOrthogonal(), across = ahead.cross(side);
  for (int n = 0; n < count; ++n) {
    NewPoint p;
    for (int r = 0; r < 3; ++r) p.x[r] = random.uniform(box.lo[r], box.hi[r]);
    const double a = half_angle * random.uniform(-1.0, 1.0), b = half_angle * random.uniform(-1.0, 1.0);
    p.v = speed * (ahead + std::tan(a) * side + std::tan(b) * across).normalized();
    p.mass = water.model().density * h * h * h / 8;
    water.add(p);
  }
}

struct Highest {
  double energy_gain = 0;  ///< largest rise of the energy above its start, over the kinetic energy then
  double speed = 0;        ///< [m/s]
  double free_fall = 0;    ///< speed gained in free fall meanwhile [m/s]
  double momentum_gap = 0;
};

Highest follow(FluidSystem& water, double seconds) {
  const double start = energy(water), kinetic = water.kinetic_energy();
  const double dt = water.limits().step;
  Highest out;
  out.free_fall = gravity.norm() * seconds;
  for (int n = 0; n * dt < seconds; ++n) {
    step_water(water, n * dt, dt);
    out.speed = std::max(out.speed, water.largest_speed());
    if (n % 10 == 0) out.energy_gain = std::max(out.energy_gain, (energy(water) - start) / kinetic);
  }
  Vec3 loads = Vec3::Zero();
  for (const WallLoad& load : water.wall_loads()) loads += load.impulse;
  const Vec3 gap = water.momentum() + loads - water.impulse_from_gravity() - water.momentum_added();
  out.momentum_gap = gap.norm() / water.momentum_added().norm();
  return out;
}

MpmConfig coarse_water(double h) {
  MpmConfig config;
  config.spacing = h;
  config.fastest_bulk_speed = 7;
  config.fastest_speed = 21;
  return config;
}

// Between spray and bulk, the share of the velocity that points take from nodes differs from node to node.
TEST(Energy, OfASprayAtTheEdgeOfBulkDoesNotGrow) {
  const double h = 0.08, speed = 19;
  const Walls no_walls;
  for (const double per_cell : {0.5, 1.0, 2.0}) {
    auto water = make_mpm(coarse_water(h), open_box(Vec3(-2, -2, -4), Vec3(4, 2, 2)), gravity, no_walls);
    add_spray(*water, {Vec3(-0.4, -0.4, -0.4), Vec3(0.4, 0.4, 0.4)}, h, per_cell, Vec3(0.6, 0, -0.8), speed,
              0.2);
    const Highest highest = follow(*water, 0.1);
    EXPECT_LT(highest.energy_gain, 1e-4) << per_cell << " points a cell";
    EXPECT_LT(highest.speed, speed + highest.free_fall) << per_cell << " points a cell";
  }
}

/// A corner closed by two upright walls and a slope above, 50 degrees from the wall behind: the underside of
/// a ledge. The apex is the origin, the open side +x.
Walls wedge() {
  const double slope = 50 * std::numbers::pi / 180, size = 1.2;
  const Vec3 down(std::sin(slope), 0, -std::cos(slope));
  std::vector<Wall> parts;
  parts.push_back(
      rectangle("behind", {Vec3(0, -size, -2), Vec3(0, size, -2), Vec3(0, size, 0.5), Vec3(0, -size, 0.5)}));
  parts.push_back(rectangle("ledge", {Vec3(0, -size, 0), Vec3(0, size, 0), Vec3(0, size, 0) + size * down,
                                      Vec3(0, -size, 0) + size * down}));
  parts.push_back(
      rectangle("side", {Vec3(-0.2, 0, -2), Vec3(size, 0, -2), Vec3(size, 0, 0.5), Vec3(-0.2, 0, 0.5)}));
  return Walls(std::move(parts));
}

/// Into the corner below the ledge.
Highest spray_into_wedge(double per_cell, double speed, WallSlip slip) {
  const double h = 0.08;
  MpmConfig config = coarse_water(h);
  config.wall_slip = slip;
  const Walls walls = wedge();
  auto water = make_mpm(config, open_box(Vec3(-2, -4, -4.5), Vec3(4, 2, 3)), gravity, walls);
  add_spray(*water, {Vec3(0.02, -0.5, -1.2), Vec3(0.5, -0.02, -0.7)}, h, per_cell, Vec3(-0.2, 0.2, 1), speed,
            0.3);
  return follow(*water, 0.1);
}

TEST(Energy, OfASprayIntoAClosedWedgeDoesNotGrow) {
  const double speed = 19;
  for (const WallSlip slip : {WallSlip::slip, WallSlip::turbulent_film, WallSlip::no_slip})
    for (const double per_cell : {0.3, 1.0}) {
      const Highest highest = spray_into_wedge(per_cell, speed, slip);
      EXPECT_LT(highest.energy_gain, 1e-4) << per_cell << " points a cell";
      EXPECT_LT(highest.speed, speed + highest.free_fall) << per_cell << " points a cell";
      EXPECT_LT(highest.momentum_gap, 1e-5) << per_cell << " points a cell";
    }
}

// Half a cell full, it is bulk: it is pressed where the wedge ends, and some of it jets out faster than it
// came.
TEST(Energy, OfADenseJetIntoAClosedWedgeDoesNotGrow) {
  const Highest highest = spray_into_wedge(4.0, 19, WallSlip::slip);
  EXPECT_LT(highest.energy_gain, 1e-3);
  EXPECT_LT(highest.momentum_gap, 1e-5);
}

// A fan that lands on a sloping ledge and runs down it.
TEST(Energy, OfASprayOntoALedgeDoesNotGrow) {
  const double h = 0.08, speed = 19;
  std::vector<Wall> parts;
  parts.push_back(rectangle("ledge", {Vec3(-0.5, -0.5, 0.35), Vec3(0.5, -0.5, -0.35), Vec3(0.5, 0.5, -0.35),
                                      Vec3(-0.5, 0.5, 0.35)}));
  const Walls walls(std::move(parts));
  for (const double per_cell : {0.3, 1.0}) {
    auto water = make_mpm(coarse_water(h), open_box(Vec3(-4, -4, -4), Vec3(4, 4, 3)), gravity, walls);
    add_spray(*water, {Vec3(-0.4, -0.3, 0.5), Vec3(0.2, 0.3, 1.1)}, h, per_cell, Vec3(0.2, 0, -1), speed,
              0.2);
    const Highest highest = follow(*water, 0.12);
    EXPECT_LT(highest.energy_gain, 1e-4) << per_cell << " points a cell";
    EXPECT_LT(highest.speed, speed + highest.free_fall) << per_cell << " points a cell";
    EXPECT_LT(highest.momentum_gap, 1e-5) << per_cell << " points a cell";
  }
}

}  // namespace
}  // namespace sluice
