// Superquadrics in the whole system: on planes, edges and each other.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "dem/dem_scenes.h"
#include "dem/superquadric_contact.h"

namespace sluice {
namespace {

using namespace test;

constexpr double size = 0.02;

TEST(RoundSuperquadric, MovesAsTheSphereItIs) {
  // An ellipsoid with axes alike to 1e-9 takes the superquadric path.
  RockShape nearly = make_superquadric(1 + 1e-9, 1, 2);
  ASSERT_FALSE(nearly.is_sphere());
  const Walls walls = walls_of(plane_wall(0.3, 5));
  std::array<Vec3, 2> x, w;
  for (std::size_t k = 0; k < 2; ++k) {
    DemSystem dem({}, scene_of({0.4, 0.5, 0}, size, {k == 0 ? make_sphere() : nearly}), walls);
    dem.add({.x = {0, 0, 0.01}, .v = {0.5, 0, 0}, .size = size});
    dem.add({.x = {0.03, 0.002, 0.012}, .v = {-0.5, 0, 0}, .size = size});
    const double dt = 4e-6;
    run(dem, 0.08, dt);
    x[k] = dem.rocks().x[1];
    w[k] = dem.rocks().w[1];
  }
  EXPECT_LT((x[0] - x[1]).norm(), 2e-6);
  EXPECT_LT((w[0] - w[1]).norm(), 1e-2 * w[0].norm());
}

TEST(Sphere, MovesAlikeWhetherOrNotTheSceneHasSuperquadrics) {
  const Walls walls = walls_of(plane_wall(0.3, 5));
  std::array<Vec3, 2> x, w;
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<RockShape> shapes{make_sphere()};
    if (k == 1) shapes.push_back(make_superquadric(1.3, 0.8, 4));
    DemConfig config;
    config.stiffness_per_size = 4e6;
    DemSystem dem(config, scene_of({0.4, 0.5, 0}, size, shapes), walls);
    dem.add({.x = {0, 0, 0.01}, .v = {0.5, 0, 0}, .size = size});
    dem.add({.x = {0.03, 0.002, 0.012}, .v = {-0.5, 0, 0}, .w = {30, -20, 10}, .size = size});
    run(dem, 0.05, 4e-6);
    x[k] = dem.rocks().x[1];
    w[k] = dem.rocks().w[1];
  }
  EXPECT_GT((w[0] - Vec3(30, -20, 10)).norm(), 1);
  EXPECT_LT((x[0] - x[1]).norm(), 1e-10);
  EXPECT_LT((w[0] - w[1]).norm(), 1e-9 * w[0].norm());
}

TEST(Superquadric, ComesToRestOnAPlane) {
  const Walls walls = walls_of(plane_wall(0.3, 7));
  DemSystem dem({}, scene_of({0.3, 0.5, 0.05}, size, {make_superquadric(1.3, 0.8, 4)}), walls);
  dem.add({.x = {0.01, 0.02, 0.025},
           .q = Quat(Eigen::AngleAxisd(0.4, Vec3(1, 2, 0.5).normalized())),
           .size = size});
  const double before = dem.energy().potential;
  run(dem, 1);
  EXPECT_LT(dem.energy().kinetic, 1e-5 * before);
  EXPECT_NEAR(dem.rocks().x[0].z(), 0.5 * 0.8 * size, 0.01 * size);  // on its flat side
}

TEST(Superquadric, IsHeldBackByASheetFromEitherSideAtEightMetresASecond) {
  const Walls walls = walls_of(plane_wall(0.2, 8));
  Random random(3);
  for (int trial = 0; trial < 12; ++trial) {
    const double side = trial % 2 == 0 ? 1 : -1;
    DemScene scene = scene_of({0.2, 0.5, 0}, size, {make_superquadric(1.6, 0.6, trial % 3 == 0 ? 8 : 3)});
    scene.gravity = Vec3::Zero();
    DemSystem dem({}, scene, walls);
    dem.add({.x = {0.02 * (trial % 5), 0.013, 0.03 * side},
             .v = {0, 1, -8 * side},
             .w = 30 * random.on_sphere(),
             .q = random.rotation(),
             .size = size});
    const double dt = dem.step_size();
    for (int k = 0; k * dt < 0.02; ++k) {
      dem.step(k * dt, dt);
      ASSERT_GT(dem.rocks().x[0].z() * side, 0.2 * size);
    }
    EXPECT_GT(dem.rocks().v[0].z() * side, 0);
  }
}

TEST(Superquadric, TouchesAnEdgeOnceAndBouncesOffIt) {
  Wall wall;
  wall.material = 1;
  wall.mesh = make_box("box", {Vec3(-0.1, -0.1, -0.1), Vec3(0.1, 0.1, 0)});
  const Walls walls = walls_of(std::move(wall));
  DemScene scene = scene_of({1, 0, 0}, size, {make_superquadric(1.2, 0.9, 2.5)});
  scene.gravity = Vec3::Zero();
  DemSystem dem({}, scene, walls);
  const Vec3 away = Vec3(1, 0, 1).normalized();
  dem.add({.x = Vec3(0.1, 0.013, 0) + 0.015 * away, .v = -1.0 * away, .size = size});
  const double before = dem.energy().kinetic, dt = dem.step_size();
  std::size_t most = 0;
  for (int k = 0; k * dt < 0.02; ++k) {
    dem.step(k * dt, dt);
    most = std::max(most, dem.contact_count());
  }
  EXPECT_EQ(most, 1u);
  EXPECT_EQ(dem.contact_count(), 0u);
  EXPECT_NEAR(dem.energy().kinetic, before, 0.01 * before);
  EXPECT_GT(dem.rocks().v[0].dot(away), 0.3);
}

TEST(Superquadrics, KeepMomentumAndEnergyInCollision) {
  for (double m : {2.5, 4.0}) {
    DemScene scene = scene_of({1, 0, 0}, size, {make_superquadric(1.5, 0.8, m)});
    scene.gravity = Vec3::Zero();
    const Walls none;
    DemConfig config;
    config.steps_per_contact = 60;
    DemSystem dem(config, scene, none);
    Random random(5);
    for (int i = 0; i < 27; ++i)
      dem.add({.x = 0.035 * Vec3(i % 3, i / 3 % 3, i / 9),
               .v = 2 * random.on_sphere(),
               .w = 20 * random.on_sphere(),
               .q = random.rotation(),
               .size = size});
    const auto angular = [&] {
      Vec3 sum = Vec3::Zero();
      const Rocks& r = dem.rocks();
      for (std::size_t i = 0; i < r.count(); ++i)
        sum += r.mass[i] * r.x[i].cross(r.v[i]) +
               r.q[i] * Vec3(dem.inertia(i).cwiseProduct(r.q[i].conjugate() * r.w[i]));
      return sum;
    };
    const Vec3 p = dem.momentum(), l = angular();
    const double before = dem.energy().kinetic;
    run(dem, 0.05);
    const double scale = 27 * dem.rocks().mass[0] * 2;
    EXPECT_LT((dem.momentum() - p).norm(), 1e-13 * scale);
    EXPECT_LT((angular() - l).norm(), 1e-13 * scale);
    EXPECT_NEAR(dem.energy().kinetic + dem.energy().elastic, before, 0.01 * before) << m;
    EXPECT_GT(dem.overlap_max(), 0.1);
  }
}

}  // namespace
}  // namespace sluice
