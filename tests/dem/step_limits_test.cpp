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

DemScene elastic_scene(double restitution) {
  PairProperties pair{restitution, 0, 0};
  pair.law = ForceLaw::hertz_mindlin;
  DemScene scene = scene_of(pair, 0.02);
  for (Material& material : scene.materials.all) {
    material.youngs_modulus = 1e8;
    material.poissons_ratio = 0.25;
  }
  return scene;
}

TEST(StepLimits, AreThoseOfTheShortestHertzContactWhereNoneIsLinear) {
  DemConfig config;
  config.impact_speed = 3;
  config.network_fraction = 1;
  const DemScene scene = elastic_scene(1);
  const DemStepLimits limits = choose_limits(config, scene);
  // 2.87 (m^2 / (R E^2 v))^(1/5) of two equal rocks
  const double mass = rock_density * M_PI / 6 * 8e-6 / 2, modulus = 1e8 / (2 * (1 - 0.0625));
  EXPECT_NEAR(limits.contact_time / std::pow(mass * mass / (0.005 * modulus * modulus * 3), 0.2), 2.8682655,
              1e-6);
  EXPECT_EQ(limits.stiffness_per_size, 0);
  EXPECT_STREQ(limits.stiffness_from, "youngs_modulus");
  EXPECT_EQ(limits.contact, "hertz_mindlin, rock on rock");
  EXPECT_LE(limits.step, limits.contact_time / 30);
  EXPECT_FALSE(linear_law_used(scene.materials));
  // Faster impacts, stiffer materials and adhesion ask for shorter steps.
  config.impact_speed = 6;
  EXPECT_NEAR(choose_limits(config, scene).contact_time / limits.contact_time, std::pow(2, -0.2), 1e-9);
  DemScene sticky = scene;
  for (PairProperties& pair : sticky.materials.pairs) pair.adhesion = 1e4;
  EXPECT_LT(choose_limits(config, sticky).network, choose_limits(config, scene).network);
}

TEST(StepLimits, KnowTheOverlapOfAHertzImpactAtTheSpeedStated) {
  const Walls walls = walls_of(plane_wall(1));
  DemConfig config;
  config.impact_speed = 3;
  DemScene scene = elastic_scene(1);
  scene.gravity = Vec3::Zero();
  DemSystem dem(config, scene, walls);
  dem.add({.x = {0, 0, 0.01001}, .v = {0, 0, -3}, .size = 0.02});
  run(dem, 0.003);
  EXPECT_NEAR(dem.overlap_max() / 100, dem.limits().hertz_overlap, 2e-3 * dem.limits().hertz_overlap);
}

TEST(StepLimits, AreTheShorterOfBothLawsAndLeaveOutPairsThatNeverMeet) {
  DemConfig config;
  DemScene scene = elastic_scene(0.5);
  const DemStepLimits elastic = choose_limits(config, scene);
  scene.materials.pairs[0].law = ForceLaw::linear;  // rock on rock
  const DemStepLimits both = choose_limits(config, scene);
  EXPECT_TRUE(linear_law_used(scene.materials));
  EXPECT_GT(both.stiffness_per_size, 0);
  EXPECT_GT(both.hertz_overlap, 0);
  config.stiffness_per_size = 1e10;
  EXPECT_EQ(choose_limits(config, scene).contact, "");
  EXPECT_LT(choose_limits(config, scene).step, elastic.step);
  scene.materials.pairs[0].meets = false;
  EXPECT_FALSE(linear_law_used(scene.materials));
  EXPECT_EQ(choose_limits(config, scene).contact, "hertz_mindlin, rock on steel");
}

}  // namespace
}  // namespace sluice
