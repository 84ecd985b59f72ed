/// Rocks in water that moves: the coupling with the material point method.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "coupling/pool.h"

namespace sluice {
namespace {

double terminal_velocity(DragModel model, double d) {
  const double weight = std::numbers::pi / 6 * d * d * d * 1650 * 9.81;
  double lo = 0, hi = 20;
  for (int i = 0; i < 200; ++i) {
    DragInput in;
    in.diameter = d;
    in.speed = 0.5 * (lo + hi);
    (drag_per_speed(model, in) * in.speed < weight ? lo : hi) = in.speed;
  }
  return lo;
}

TEST(TwoWayCoupling, LetsARockFallAtItsTerminalVelocity) {
  const double d = 0.01;
  Pool pool(0.32, 0.8, 0.04, {.size = d}, CouplingConfig{});
  NewRock rock;
  rock.x = {0.16, 0.16, 0.7};
  rock.size = d;
  pool.rocks->add(rock);
  double sum = 0;
  int count = 0;
  while (pool.rocks->rocks().x[0].z() > 0.25 && pool.t < 1.5) {
    pool.step(Pool::Rocks::falling);
    if (pool.rocks->rocks().x[0].z() > 0.4) continue;
    sum -= pool.rocks->rocks().v[0].z();
    ++count;
  }
  ASSERT_GT(count, 100);
  const double expected = terminal_velocity(DragModel::di_felice, d);
  EXPECT_GT(1000 * expected * d / 1e-3, 100) << "Reynolds number";
  EXPECT_GE(pool.coupling->smallest_kernel_ratio(), 4);
  EXPECT_NEAR(sum / count, expected, 0.05 * expected);
}

// Pressure noise reaches a rock through its buoyancy: rms 5 % of its weight at most, mean 2 %.
TEST(Buoyancy, IsAsQuietAsTheStillWaterIs) {
  const double d = 0.03, h = 0.02;
  Pool pool(8 * h, 0.3, h, {.size = d}, CouplingConfig{});
  for (const Vec3& x : {Vec3(0.05, 0.06, 0.08), Vec3(0.11, 0.1, 0.15), Vec3(0.07, 0.03, 0.2)})
    pool.rocks->add({.x = x, .size = d});
  double mean = 0, square = 0;
  int count = 0;
  while (pool.t < 0.5) {
    pool.step(Pool::Rocks::held);
    if (pool.t < 0.25) continue;
    for (std::size_t r = 0; r < 3; ++r) {
      const Vec3 force = pool.coupling->drag_force()[r] + pool.coupling->buoyancy_force()[r];
      const double displaced = 1000 * 9.81 * pool.rocks->volume(r), weight = 2.65 * displaced;
      mean += force.z() / displaced;
      square += (force - Vec3(0, 0, displaced)).squaredNorm() / (weight * weight);
      ++count;
    }
  }
  EXPECT_NEAR(mean / count, 1, 0.02);
  EXPECT_LT(std::sqrt(square / count), 0.05);
}

// Rocks of volume V held under water of area A: the level rises by V/A. The centroid of water that fills
// (depth + rise) with rocks spread evenly over the lower part is what is compared, through its own balance.
TEST(Level, RisesByTheRocksVolumeOverTheArea) {
  const double width = 0.2, depth = 0.4, d = 0.05;
  Pool pool(width, depth, 0.025, {.size = d}, CouplingConfig{});
  double volume = 0;
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        NewRock rock;
        rock.x = {0.05 + 0.1 * i, 0.05 + 0.1 * j, 0.08 + 0.08 * k};
        rock.size = d;
        pool.rocks->add(rock);
        volume += pool.rocks->volume(pool.rocks->rocks().count() - 1);
      }
  const double before = pool.centroid();
  double sum = 0;
  int count = 0;
  while (pool.t < 1.5) {
    pool.step(Pool::Rocks::held);
    if (pool.t < 0.75) continue;
    sum += pool.centroid();
    ++count;
  }
  // Water (height H = depth + rise, area A) and rock (centred at their mean height) together fill A H evenly:
  // A H (H/2) = V z_rock + A depth z_water.
  const double rise = volume / (width * width), height = depth + rise;
  const double z_rock = 0.2;
  const double expected = (height * height / 2 - rise * z_rock) / depth;
  EXPECT_NEAR((sum / count - before) / (expected - before), 1.0, 0.1);
}

}  // namespace
}  // namespace sluice
