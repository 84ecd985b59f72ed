// Blocky rocks on flat faces: they rest, stay where they are, and keep energy.
#include "dem/faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/memory_archive.h"
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

double height(const Block& block) {
  return 0.5 * block.flatness * size;
}

Quat slightly_turned() {
  return Quat(Eigen::AngleAxisd(0.1, Vec3(1, 2, 0.5).normalized()));
}

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
    run(dem, 0.8);
    const double most = most_kinetic(dem, 0.8, 1, unit);
    EXPECT_LT(most, 1e-8);
    EXPECT_EQ(dem.contact_count(), 1u);
    EXPECT_NEAR(dem.rocks().x[0].z(), height(block), 0.01 * size);
  }
}

TEST(BlockyRock, ComesToRestOnAPlane) {
  expect_rest_on_plane(1);
}
TEST(BlockyRock, ComesToRestOnAMesh) {
  expect_rest_on_plane(31);
}

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
    EXPECT_EQ(dem.contact_count(), 1u);
    EXPECT_LT(creep, 1e-6);  // 1e-4 in 10 s, and room
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

TEST(BlockyRocks, KeepEnergyInABounceOfSome200StepsAContact) {
  for (const auto& [m, bound] : {std::pair(8.0, 2e-3), std::pair(16.0, 1e-2)})
    for (double below : {1.0, 3.0})
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        EXPECT_LT(
            energy_error(make_superquadric(1.3, 0.8, m), make_superquadric(1, 1, m), below * size, 200, seed),
            bound)
            << m << " on " << below;
      }
}

TEST(BlockyRocks, KeepEnergyAgainstRounderOnes) {
  for (double m : {8.0, 16.0})
    for (double round : {2.0, 4.0}) {
      const RockShape blocky = make_superquadric(1.3, 0.8, m), other = make_superquadric(1.2, 0.9, round);
      EXPECT_LT(energy_error(blocky, other, 3 * size, 200, 1), 2e-3) << m << " on " << round;
      EXPECT_LT(energy_error(other, blocky, 3 * size, 200, 1), 2e-3) << round << " on " << m;
    }
}

DemScene cloud_scene(const PairProperties& pair) {
  DemScene scene = scene_of(pair, size,
                            {make_superquadric(1.5, 0.8, 8), make_superquadric(1, 0.7, 16), make_sphere(),
                             make_superquadric(1.2, 0.9, 4)});
  scene.smallest_size = 0.6 * size;
  return scene;
}

void fill_cloud(DemSystem& dem, int n, double speed) {
  Random random(21);
  for (int i = 0; i < n * n * n; ++i)
    dem.add({.x = 1.9 * size * Vec3(i % n - 0.5 * n, i / n % n - 0.5 * n, i / n / n + 0.7),
             .v = speed * random.on_sphere(),
             .w = 20 * random.on_sphere(),
             .q = random.rotation(),
             .shape = i % 4,
             .size = random.uniform(0.6, 1) * size});
}

/// Pushes all rocks towards the middle from now on.
void draw_together(DemSystem& dem, double per_length) {
  std::vector<Vec3> force;
  for (const Vec3& x : dem.rocks().x) force.push_back(-per_length * (x - Vec3(0, 0, 0.05)));
  dem.set_fluid_force(force, std::vector<Vec3>(force.size(), Vec3::Zero()));
}

TEST(BlockyRocks, KeepMomentumAndAngularMomentumInCollisions) {
  DemScene scene = cloud_scene({0.5, 0.5, 0.02});
  scene.gravity = Vec3::Zero();
  const Walls none;
  DemSystem dem({}, scene, none);
  fill_cloud(dem, 4, 0);
  draw_together(dem, 20);
  run(dem, 0.03);
  draw_together(dem, 0);
  const auto angular = [&] {
    Vec3 sum = Vec3::Zero();
    const Rocks& r = dem.rocks();
    for (std::size_t i = 0; i < r.count(); ++i)
      sum += r.mass[i] * r.x[i].cross(r.v[i]) +
             r.q[i] * Vec3(dem.inertia(i).cwiseProduct(r.q[i].conjugate() * r.w[i]));
    return sum;
  };
  const Vec3 p = dem.momentum(), l = angular();
  const double moved = dem.energy().kinetic, scale = std::sqrt(2 * moved * 64 * dem.rocks().mass[0]);
  run(dem, 0.05);
  EXPECT_LT(dem.energy().kinetic, 0.9 * moved);
  EXPECT_LT((dem.momentum() - p).norm(), 1e-12 * scale);
  EXPECT_LT((angular() - l).norm(), 1e-12 * scale * size);
}

TEST(BlockyRocks, GiveTheSameBitsWithAnyNumberOfThreadsAndAfterARestart) {
  const int threads = thread_count();
  const Walls walls = walls_of(plane_wall(1, 5));
  const DemScene scene = cloud_scene({0.3, 0.5, 0.05});
  std::uint64_t expected = 0;
  for (int n : {1, 2, 3}) {
    set_thread_count(n);
    DemSystem dem({}, scene, walls);
    fill_cloud(dem, 7, 0);  // more than a chunk: they are sorted
    draw_together(dem, 150);
    const double dt = dem.step_size();
    const int half = 4500, all = 6000;
    run(dem, half * dt, dt);
    EXPECT_GT(dem.contact_count(), 30u);
    MemoryArchive archive;
    dem.exchange(archive);
    archive.rewind_to_load();
    DemSystem again({}, scene, walls);
    again.exchange(archive);
    for (int k = half; k < all; ++k)
      for (DemSystem* one : {&dem, &again}) one->step(k * dt, dt);
    if (n == 1) expected = dem.state_hash();
    EXPECT_EQ(dem.state_hash(), expected);
    EXPECT_EQ(again.state_hash(), expected);
    EXPECT_EQ(again.contact_count(), dem.contact_count());
    EXPECT_EQ(again.overlap_mean(), dem.overlap_mean());
  }
  set_thread_count(threads);
}

TEST(FaceCopies, TouchThePlanesThatBoundTheRockAndStayInside) {
  Random random(5);
  for (double m : {6.5, 8.0, 16.0})
    for (const auto& [elongation, flatness] :
         {std::pair(1.0, 1.0), std::pair(4.0, 1.0), std::pair(4.0, 0.25)}) {
      const RockShape shape = make_superquadric(elongation, flatness, m);
      const FaceCopies copies = make_face_copies(shape.semi_axes, m);
      EXPECT_GT(copies.semi_axes.cwiseQuotient(shape.semi_axes).minCoeff(), 0.94);
      for (const Quat& turn : copies.turns) {
        EXPECT_LT(turn.angularDistance(Quat::Identity()), 1.8 * face_turn);
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(support_height(copies.semi_axes, m, turn.conjugate() * Vec3::Unit(k)),
                      shape.semi_axes[k], 1e-14 * elongation);
        for (int i = 0; i < 200; ++i) {
          const Vec3 n = random.on_sphere();
          EXPECT_LT(support_height(copies.semi_axes, m, turn.conjugate() * n),
                    1.02 * support_height(shape.semi_axes, m, n));
        }
      }
    }
}

TEST(FaceCopies, TogetherAreAsStiffAsOneContact) {
  for (const Block& block : blocks) {
    const Walls walls = walls_of(plane_wall(0.3));
    DemScene scene = scene_of({1, 0, 0}, size, {shape_of(block)});
    scene.gravity = Vec3::Zero();
    DemSystem dem({}, scene, walls);
    const double overlap = 1e-3 * size;
    dem.add({.x = {0.01, 0.02, height(block) - overlap}, .size = size});
    dem.step(0, 1e-12);
    const double k_n = dem.limits().stiffness_per_size * size;
    EXPECT_NEAR(dem.energy().elastic, 0.5 * k_n * overlap * overlap, 1e-9 * k_n * overlap * overlap);
    EXPECT_EQ(dem.contact_count(), 1u);
    EXPECT_NEAR(dem.overlap_max(), 100 * 2 * overlap / size, 1e-9);
    EXPECT_NEAR(dem.overlap_mean(), 100 * 2 * overlap / size, 1e-9);
    // Flat on its face: no torque.
    EXPECT_LT(dem.rocks().w[0].norm() * size, 1e-9 * dem.rocks().v[0].norm());
  }
}

}  // namespace
}  // namespace sluice
