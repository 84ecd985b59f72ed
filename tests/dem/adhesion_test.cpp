// Adhesion: the force that draws two touching bodies apart, and its energy.
#include <gtest/gtest.h>

#include <cmath>

#include "dem/dem_scenes.h"

namespace sluice {
namespace {

using namespace test;

constexpr double size = 0.02;

DemScene sticky_scene(ForceLaw law, double restitution, double adhesion) {
  PairProperties pair{restitution, 0.5, 0};
  pair.law = law;
  pair.adhesion = adhesion;
  DemScene scene = scene_of(pair, size);
  scene.gravity = Vec3::Zero();
  for (Material& material : scene.materials.all) {
    material.youngs_modulus = 1e7;
    material.poissons_ratio = 0.25;
  }
  return scene;
}

/// Soft, so that the pull makes overlaps that matter: 1 N on 2e4 N/m.
DemConfig soft() {
  DemConfig config;
  config.stiffness_per_size = 1e6;
  config.impact_speed = 0.5;
  return config;
}

/// True if a rock held by adhesion is drawn off by this force [N] within a second.
bool lets_go(ForceLaw law, bool on_wall, double force) {
  const Walls walls = on_wall ? walls_of(plane_wall(0.1)) : Walls();
  DemSystem dem(soft(), sticky_scene(law, 0.1, 100), walls);
  dem.add({.x = {0, 0, on_wall ? 0.00995 : 0.01997}, .size = size});
  if (!on_wall) dem.add({.size = size});
  run(dem, 0.05);
  EXPECT_EQ(dem.contact_count(), 1u);
  std::vector<Vec3> pull(dem.rocks().count(), Vec3::Zero()), none(dem.rocks().count(), Vec3::Zero());
  const int steps = static_cast<int>(0.1 / dem.step_size());
  for (int k = 0; k < 3 * steps; ++k) {
    pull[0].z() = std::min(1.0, 0.5 * k / steps) * force;
    if (!on_wall) pull[1].z() = -pull[0].z();
    dem.set_fluid_force(pull, none);
    dem.step(0.05 + k * dem.step_size(), dem.step_size());
  }
  return dem.contact_count() == 0;
}

TEST(Adhesion, HoldsUpToItsPullOffForceUnderBothLaws) {
  for (ForceLaw law : {ForceLaw::linear, ForceLaw::hertz_mindlin}) {
    // R* is 5 mm for two rocks of 20 mm and 10 mm for one on a wall; 100 N/m.
    EXPECT_FALSE(lets_go(law, false, 0.99 * 0.5));
    EXPECT_TRUE(lets_go(law, false, 1.01 * 0.5));
    EXPECT_FALSE(lets_go(law, true, 0.99 * 1));
    EXPECT_TRUE(lets_go(law, true, 1.01 * 1));
  }
}

TEST(Adhesion, GivesBackWhatItTookInAnElasticImpact) {
  for (ForceLaw law : {ForceLaw::linear, ForceLaw::hertz_mindlin}) {
    DemConfig config = soft();
    config.steps_per_contact = 20000;
    const Walls walls = walls_of(plane_wall(0.1));
    DemSystem dem(config, sticky_scene(law, 1, 100), walls);
    dem.add({.x = {0, 0, 0.010001}, .v = {0, 0, -0.3}, .size = size});
    const double before = dem.energy().kinetic, dt = dem.step_size();
    double most = 0;
    for (int k = 0; k < 20 || dem.contact_count() > 0 || most == before; ++k) {
      dem.step(k * dt, dt);
      most = std::max(most, dem.energy().kinetic);
      if (dem.contact_count() > 0) {
        ASSERT_NEAR(dem.energy().kinetic + dem.energy().elastic, before, 2e-3 * before);
      }
      if (most == before && k > 100000) break;
    }
    EXPECT_NEAR(dem.rocks().v[0].z(), 0.3, 1e-3);
    EXPECT_GT(most, 1.02 * before);  // drawn in, faster than it came
  }
}

TEST(Adhesion, KeepsASlowDampedImpactFromRebounding) {
  for (ForceLaw law : {ForceLaw::linear, ForceLaw::hertz_mindlin}) {
    const Walls walls = walls_of(plane_wall(0.1));
    DemSystem dem(soft(), sticky_scene(law, 0.5, 100), walls);
    dem.add({.x = {0, 0, 0.01001}, .v = {0, 0, -0.01}, .size = size});
    run(dem, 0.2);
    EXPECT_EQ(dem.contact_count(), 1u);
    EXPECT_LT(dem.rocks().v[0].norm(), 1e-6);
    const DemEnergy e = dem.energy();
    EXPECT_LT(e.elastic, 0);  // in the well
    EXPECT_NEAR(e.elastic + e.kinetic + e.dissipated_normal, 0.5 * dem.rocks().mass[0] * 1e-4,
                0.01 * e.dissipated_normal);
  }
}

TEST(Adhesion, LeavesCoulombsLimitToTheForceThatPressesTheRocksTogether) {
  // At rest the spring carries the pull of 1 N, so friction holds 0.5 N.
  for (ForceLaw law : {ForceLaw::linear, ForceLaw::hertz_mindlin}) {
    for (double share : {0.97, 1.03}) {
      const Walls walls = walls_of(plane_wall(0.1));
      DemSystem dem(soft(), sticky_scene(law, 0.2, 100), walls);
      dem.add({.x = {0, 0, 0.00995}, .size = size});
      run(dem, 0.05);
      // A force and a torque that load the touching point only: F along x, no turning.
      const double force = share * 0.5;
      const std::vector<Vec3> f{{force, 0, 0}}, torque{{0, -0.01 * force, 0}};
      dem.set_fluid_force(f, torque);
      run(dem, 0.05);
      EXPECT_EQ(dem.rocks().v[0].norm() > 0.02, share > 1) << share;
    }
  }
}

}  // namespace
}  // namespace sluice
