// Blocky rocks on flat faces: they rest, stay where they are, and keep energy.
#include "dem/faces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "base/parallel.h"
#include "base/random.h"
#include "dem/dem_scenes.h"

namespace sluice {
namespace {

using namespace test;

constexpr double size = 0.02;

struct Block {
  double elongation, flatness, blockiness;
};
constexpr Block blocks[] = {{1, 1, 8}, {1, 1, 16}, {2, 0.6, 8}, {2, 0.6, 16}};

RockShape shape_of(const Block& block) {
  return make_superquadric(block.elongation, block.flatness, block.blockiness);
}

double height(const Block& block) { return 0.5 * block.flatness * size; }

Quat slightly_turned() { return Quat(Eigen::AngleAxisd(0.1, Vec3(1, 2, 0.5).normalized())); }

/// Largest kinetic energy over m g a within `seconds`.
double most_kinetic(DemSystem& dem, double from, double seconds, double energy_unit) {
  const double dt = dem.step_size();
  double most = 0;
  for (int k = 0; k * dt < seconds; ++k) {
    dem.step(from + k * dt, dt);
    if (k % 50 == 0) most = std::max(most, dem.energy().kinetic / energy_unit);
  }
  return most;
}

void expect_rest_on_plane(int squares) {
  for (const Block& block : blocks) {
    const Walls walls = walls_of(plane_wall(0.3, squares));
    DemSystem dem({}, scene_of({0.3, 0.5, 0}, size, {shape_of(block)}), walls);
    dem.add({.x = {0.01, 0.02, 1.4 * size}, .q = slightly_turned(), .size = size});
    const double unit = dem.rocks().mass[0] * 9.81 * 0.5 * size;
    run(dem, 1.5);
    const double most = most_kinetic(dem, 1.5, 1, unit);
    std::printf("rest %g %g: %g contacts %zu dt %g z %g\n", block.elongation, block.blockiness, most,
                dem.contact_count(), dem.step_size(), dem.rocks().x[0].z() / height(block));
    EXPECT_LT(most, 1e-8);
    EXPECT_EQ(dem.contact_count(), 1u);
    EXPECT_NEAR(dem.rocks().x[0].z(), height(block), 0.01 * size);
  }
}

TEST(BlockyRock, ComesToRestOnAPlane) { expect_rest_on_plane(1); }
TEST(BlockyRock, ComesToRestOnAMesh) { expect_rest_on_plane(31); }

TEST(BlockyRock, ComesToRestOnAnotherRock) {
  for (const Block& block : blocks) {
    const Walls walls = walls_of(plane_wall(0.5));
    DemScene scene = scene_of({0.3, 0.5, 0}, size, {shape_of(block), make_superquadric(1, 1, 8)});
    scene.largest_size = 5 * size;
    DemSystem dem({}, scene, walls);
    dem.add({.x = {0, 0, 2.5 * size}, .shape = 1, .size = 5 * size});
    dem.add({.x = {0.01, 0.005, 6.2 * size}, .q = slightly_turned(), .size = size});
    const double unit = dem.rocks().mass[1] * 9.81 * 0.5 * size;
    run(dem, 1.5);
    const double most = most_kinetic(dem, 1.5, 1, unit);
    std::printf("on rock %g %g: %g contacts %zu\n", block.elongation, block.blockiness, most, dem.contact_count());
    EXPECT_LT(most, 1e-8);
    EXPECT_EQ(dem.contact_count(), 2u);
    EXPECT_GT(dem.rocks().x[1].z(), 5 * size);
  }
}

TEST(BlockyRock, DoesNotCreepOnAnIncline) {
  for (const Block& block : blocks) {
    const double slope = 20 * 3.14159265358979 / 180;
    const Walls walls = walls_of(plane_wall(0.3, 9));
    DemScene scene = scene_of({0.3, 0.5, 0}, size, {shape_of(block)});
    scene.gravity = 9.81 * Vec3(std::sin(slope), 0, -std::cos(slope));
    DemSystem dem({}, scene, walls);
    dem.add({.x = {0.01, 0.02, height(block)}, .size = size});
    run(dem, 1);
    const Vec3 before = dem.rocks().x[0];
    run(dem, 1);
    const double creep = (dem.rocks().x[0] - before).norm() / size;
    std::printf("creep %g %g: %g\n", block.elongation, block.blockiness, creep);
    EXPECT_LT(creep, 1e-5);
  }
}

/// Largest change of the total energy over the kinetic energy at impact, undamped and without friction, of a
/// rock that falls on a larger one that lies on a plane.
double energy_error(const RockShape& shape, const RockShape& below, double size_below, double per_contact,
                    std::uint64_t seed) {
  DemScene scene = scene_of({1, 0, 0}, size, {shape, below});
  scene.largest_size = std::max(size, size_below);
  DemConfig config;
  config.impact_speed = 1;
  config.network_fraction = 1;
  config.steps_per_contact = per_contact;
  const Walls walls = walls_of(plane_wall(0.3));
  DemSystem dem(config, scene, walls);
  Random random(seed);
  const double top = 2 * below.semi_axes.z() * size_below;
  const double drop = 0.3 * size;
  dem.add({.x = {0, 0, 0.5 * top}, .shape = 1, .size = size_below});
  dem.add({.x = {0.1 * size, 0.05 * size, top + shape.semi_axes.z() * size + drop},
           .q = Quat(Eigen::AngleAxisd(0.1 * random.uniform(), random.on_sphere())),
           .size = size});
  const auto energy = [&] {
    const DemEnergy e = dem.energy();
    return e.kinetic + e.elastic + e.potential;
  };
  const double before = energy();
  const double impact = dem.rocks().mass[1] * 9.81 * drop;
  const double dt = dem.step_size();
  double worst = 0;
  for (int k = 0; k * dt < 0.25; ++k) {
    dem.step(k * dt, dt);
    worst = std::max(worst, std::fabs(energy() - before) / impact);
  }
  return worst;
}

TEST(BlockyRocks, KeepEnergyInABounce) {
  for (double m : {6.0, 8.0, 16.0})
    for (double per_contact : {100.0, 200.0})
      for (double below : {1.0, 3.0}) {
        double worst = 0, sum = 0;
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
          const double error = energy_error(make_superquadric(1.3, 0.8, m), make_superquadric(1, 1, m),
                                            below * size, per_contact, seed);
          worst = std::max(worst, error);
          sum += error / 4;
        }
        std::printf("bounce m %g below %g at %g: worst %g mean %g\n", m, below, per_contact, worst, sum);
      }
  for (double m : {8.0, 16.0})
    for (double other : {2.0, 4.0}) {
      double worst = 0, worst2 = 0;
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        worst = std::max(worst, energy_error(make_superquadric(1.3, 0.8, m), make_superquadric(1.01, 1, other), 3 * size, 200, seed));
        worst2 = std::max(worst2, energy_error(make_superquadric(1.3, 0.8, other), make_superquadric(1, 1, m), 3 * size, 200, seed));
      }
      std::printf("mixed m %g other %g: worst %g %g\n", m, other, worst, worst2);
    }
}

}  // namespace
}  // namespace sluice
