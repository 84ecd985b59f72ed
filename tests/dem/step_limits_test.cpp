#include "dem/step_limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "dem/dem_scenes.h"

namespace sluice {
namespace {

using namespace test;

TEST(ContactMobility, IsOneForASphereAndFourAtTheTipOfARod) {
  EXPECT_DOUBLE_EQ(contact_mobility(make_sphere(), 2.0 / 7), 1);
  EXPECT_DOUBLE_EQ(contact_mobility(make_sphere(), 1), 3.5);
  // A blocky rod 4:1: risk 11 has m/4 for a thin one, cube corners add a little.
  const double rod = contact_mobility(make_superquadric(4, 1, 8), 2.0 / 7);
  EXPECT_GT(rod, 3);
  EXPECT_LT(rod, 6);
}

TEST(Stiffness, KeepsTheImpactOverlapAsked) {
  // m v^2 = k (xi R)^2 for a sphere on a wall: measured without damping.
  const Walls walls = walls_of(plane_wall(1));
  DemConfig config;
  config.impact_speed = 4;
  DemScene scene = scene_of({1, 0, 0}, 0.03);
  scene.gravity = Vec3::Zero();
  DemSystem dem(config, scene, walls);
  EXPECT_STREQ(dem.limits().stiffness_from, "impact_overlap");
  dem.add({.x = {0, 0, 0.0151}, .v = {0, 0, -4}, .size = 0.03});
  run(dem, 0.003);
  EXPECT_NEAR(dem.overlap_max(), 5, 0.05);
}

TEST(Stiffness, ComesFromTheRuleThatAsksForMore) {
  const Walls none;
  DemConfig config;
  config.impact_speed = 0.1;
  config.bed_depth = 5;
  EXPECT_STREQ(DemSystem(config, scene_of({0.3, 0.5, 0}, 0.02), none).limits().stiffness_from, "bed_overlap");
  config.stiffness_per_size = 1e6;
  const DemStepLimits given = DemSystem(config, scene_of({0.3, 0.5, 0}, 0.02), none).limits();
  EXPECT_STREQ(given.stiffness_from, "stiffness_per_size");
  EXPECT_EQ(given.stiffness_per_size, 1e6);
}

TEST(StepLimits, AreThoseOfTheCagedSphereAndTheEqualPair) {
  // timestep_dem_linear.csv: k_n = 1e5 N/m, m = 0.01 kg: caged by twelve 0.000252262489558 s; an equal pair
  // touches for pi sqrt(m / 2 k_n).
  DemScene scene = scene_of({1, 0, 0}, 0.02);
  const double density = 0.01 / (M_PI / 6 * 8e-6);
  scene.materials.all[0].density = scene.densest = density;
  DemConfig config;
  config.stiffness_per_size = 1e5 / 0.02;
  const DemStepLimits limits = choose_limits(config, scene);
  EXPECT_NEAR(limits.network, 0.000252262489558, 1e-12);
  EXPECT_NEAR(limits.contact_time, M_PI * std::sqrt(0.01 / 2e5), 1e-12);
  EXPECT_NEAR(limits.step, limits.contact_time / 30, 1e-15);
  EXPECT_STREQ(limits.governed_by, "steps_per_contact");
  config.steps_per_contact = 5;
  EXPECT_STREQ(choose_limits(config, scene).governed_by, "network_fraction");
}

TEST(StepLimits, ShortenWithDampingAndWithLargerPartners) {
  DemScene scene = scene_of({1, 0, 0}, 0.02);
  DemConfig config;
  const DemStepLimits plain = choose_limits(config, scene);
  scene.largest_size = 0.2;
  EXPECT_NEAR(choose_limits(config, scene).network / plain.network, std::sqrt(1.1 / 2), 1e-12);
  scene.largest_size = 0.02;
  scene.materials.pairs.assign(4, {0.5, 0, 0});
  const double zeta = 0.255275637649;
  EXPECT_NEAR(choose_limits(config, scene).network / plain.network, std::sqrt(1 + zeta * zeta) - zeta, 1e-9);
}

}  // namespace
}  // namespace sluice
