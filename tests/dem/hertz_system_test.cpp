// Many rocks under Hertz-Mindlin and adhesion: budgets, order of loops, restart.
#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "base/memory_archive.h"
#include "base/parallel.h"
#include "base/random.h"
#include "dem/dem_scenes.h"

namespace sluice {
namespace {

using namespace test;

DemScene elastic_scene(const PairProperties& like, std::vector<RockShape> shapes = {make_sphere()}) {
  PairProperties pair = like;
  pair.law = ForceLaw::hertz_mindlin;
  DemScene scene = scene_of(pair, 0.02, std::move(shapes));
  scene.smallest_size = 0.01;
  for (Material& material : scene.materials.all) {
    material.youngs_modulus = 1e8;
    material.poissons_ratio = 0.25;
  }
  return scene;
}

void fill(DemSystem& dem, int n, double spacing, const Vec3& corner, double speed, std::uint64_t seed) {
  Random random(seed);
  const std::size_t shapes = dem.shapes().size();
  for (int k = 0; k < n * n * n; ++k)
    dem.add({.x = corner + spacing * Vec3(k % n + 0.5, k / n % n + 0.5, k / (n * n) + 0.5),
             .v = speed * random.on_sphere(),
             .w = 5 * random.on_sphere(),
             .q = random.rotation(),
             .shape = static_cast<int>(static_cast<std::size_t>(k) % shapes),
             .size = random.uniform(0.01, 0.02)});
}

double total(const DemEnergy& e) {
  return e.kinetic + e.elastic + e.potential + e.dissipated_normal + e.dissipated_friction;
}

/// Largest departure of the energy budget from its start, over the kinetic energy.
double drift(const PairProperties& pair, std::vector<RockShape> shapes, double steps_per_contact) {
  DemConfig config;
  config.steps_per_contact = steps_per_contact;
  config.network_fraction = 1;
  DemScene scene = elastic_scene(pair, std::move(shapes));
  scene.gravity = Vec3::Zero();
  const Walls none;
  DemSystem dem(config, scene, none);
  fill(dem, 5, dem.shapes().size() > 1 ? 0.03 : 0.021, Vec3::Zero(), 2, 7);
  const double before = total(dem.energy()), dt = dem.step_size();
  const Vec3 momentum = dem.momentum();
  double worst = 0, scale = 0;
  for (int k = 0; k * dt < 0.02; ++k) {
    dem.step(k * dt, dt);
    worst = std::max(worst, std::abs(total(dem.energy()) - before));
  }
  for (std::size_t i = 0; i < dem.rocks().count(); ++i) scale += dem.rocks().mass[i] * 2;
  EXPECT_LT((dem.momentum() - momentum).norm(), 1e-13 * scale);
  EXPECT_GT(dem.overlap_max(), 0.5);
  return worst / before;
}

TEST(ElasticRocks, KeepTheEnergyBudgetToTheOrderOfTheStep) {
  const std::vector<RockShape> spheres{make_sphere()}, mixed{make_sphere(), make_superquadric(1.3, 0.9, 3)};
  EXPECT_LT(drift({1, 0, 0}, spheres, 60), 2e-3);
  EXPECT_LT(drift({0.6, 0.5, 0.05}, spheres, 300), 3e-3);
  EXPECT_LT(drift({0.6, 0.5, 0.05}, mixed, 300), 3e-3);
  const double coarse = drift({0.6, 0.5, 0}, spheres, 100), fine = drift({0.6, 0.5, 0}, spheres, 400);
  EXPECT_LT(fine, 0.4 * coarse);
}

/// Upright and turning about z among the rocks, over a plane.
Walls plane_and_paddle() {
  std::vector<Wall> all{plane_wall(1, 5),
                        plane_wall(0.04, 2, Quat(Eigen::AngleAxisd(0.5 * M_PI, Vec3::UnitX())))};
  all[1].motion.emplace();
  all[1].motion->kind = MotionKind::rotation;
  all[1].motion->axis = Vec3::UnitZ();
  all[1].motion->speed = 20;
  return Walls(std::move(all));
}

class ElasticRocksOf : public testing::TestWithParam<Tangential> {
 protected:
  static DemScene scene() {
    PairProperties pair{0.3, 0.5, 0.05};
    pair.adhesion = 20;
    pair.tangential = GetParam();
    return elastic_scene(pair, {make_sphere(), make_superquadric(1.5, 0.8, 3), make_superquadric(1, 1, 10)});
  }
};

TEST_P(ElasticRocksOf, EachTangentialLawGiveTheSameBitsWithAnyNumberOfThreads) {
  const int threads = thread_count();
  std::uint64_t expected = 0;
  for (int n : {1, 2, 3}) {
    set_thread_count(n);
    const Walls walls = walls_of(plane_wall(1, 5));
    DemSystem dem({}, scene(), walls);
    fill(dem, 6, 0.036, Vec3(-0.1, -0.1, 0), 5, 3);
    run(dem, 300 * dem.step_size());
    EXPECT_GT(dem.overlap_max(), 0.1);
    if (n == 1) expected = dem.state_hash();
    EXPECT_EQ(dem.state_hash(), expected);
  }
  set_thread_count(threads);
}

TEST_P(ElasticRocksOf, EachTangentialLawContinueBitForBitAfterARestart) {
  const Walls walls = plane_and_paddle();
  DemSystem first({}, scene(), walls), second({}, scene(), walls);
  fill(first, 4, 0.03, Vec3(-0.06, -0.06, 0), 8, 5);
  const double dt = first.step_size();
  run(first, 1500 * dt);
  MemoryArchive archive;
  first.exchange(archive);
  archive.rewind_to_load();
  second.exchange(archive);
  for (int k = 1500; k < 2000; ++k)
    for (DemSystem* dem : {&first, &second}) dem->step(k * dt, dt);
  EXPECT_EQ(second.state_hash(), first.state_hash());
  EXPECT_EQ(second.energy().dissipated_friction, first.energy().dissipated_friction);
  EXPECT_GT(first.overlap_max(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Laws, ElasticRocksOf,
                         testing::Values(Tangential::rescaled, Tangential::whole_stretch,
                                         Tangential::partial_slip),
                         [](const auto& given) -> std::string {
                           switch (given.param) {
                             case Tangential::rescaled:
                               return "Rescaled";
                             case Tangential::whole_stretch:
                               return "WholeStretch";
                             default:
                               return "PartialSlip";
                           }
                         });

TEST(ElasticRocks, KeepTheEnergyBudgetUnderEachTangentialLaw) {
  for (Tangential law : {Tangential::whole_stretch, Tangential::partial_slip}) {
    PairProperties pair{0.6, 0.5, 0.05};
    pair.tangential = law;
    EXPECT_LT(drift(pair, {make_sphere()}, 300), 3e-3);
    EXPECT_LT(drift(pair, {make_sphere(), make_superquadric(1.3, 0.9, 3)}, 300), 3e-3);
  }
}

TEST(ElasticRocks, RestOnASlopeByFrictionUnderEachTangentialLaw) {
  // tan = 0.45 < mu = 0.5: a block of m = 10 stays where it is; beyond 0.5 it slides off.
  for (Tangential law : {Tangential::rescaled, Tangential::whole_stretch, Tangential::partial_slip})
    for (double slope : {0.45, 0.55}) {
      PairProperties pair{0.3, 0.5, 0};
      pair.tangential = law;
      DemScene scene = elastic_scene(pair, {make_superquadric(1, 0.6, 10)});
      scene.gravity = 9.81 * Vec3(slope, 0, -1).normalized();
      const Walls walls = walls_of(plane_wall(1, 3));
      DemSystem dem({}, scene, walls);
      dem.add({.x = {0, 0, 0.00605}, .size = 0.02});
      run(dem, 0.1);
      const double settled = dem.rocks().x[0].x();
      run(dem, 0.2);
      const double moved = dem.rocks().x[0].x() - settled;
      if (slope < 0.5)
        EXPECT_LT(std::abs(moved), 1e-5) << static_cast<int>(law);
      else
        EXPECT_GT(moved, 0.01) << static_cast<int>(law);
    }
}

TEST(ElasticRocks, StopRollingWithRollingResistance) {
  // Deceleration mu_r g 5/7, as under the linear law.
  const Walls walls = walls_of(plane_wall(1));
  DemConfig config;
  config.impact_speed = 1;
  DemSystem dem(config, elastic_scene({0.3, 0.5, 0.05}), walls);
  dem.add({.x = {0, 0, 0.01}, .v = {0.5, 0, 0}, .w = {0, 50, 0}, .size = 0.02});
  run(dem, 0.5);
  EXPECT_NEAR(dem.rocks().v[0].x(), 0.5 - 0.05 * 9.81 * 5 / 7 * 0.5, 0.01);
  run(dem, 1.3);
  EXPECT_LT(dem.rocks().v[0].norm(), 1e-3);
}

TEST(ElasticRocks, AreRefusedWithoutElasticConstants) {
  const Walls none;
  const auto refuses = [&](auto change, const char* word) {
    DemScene scene = elastic_scene({0.3, 0.5, 0});
    change(scene);
    try {
      DemSystem dem({}, scene, none);
      ADD_FAILURE() << "accepted: " << word;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  refuses([](DemScene& s) { s.materials.all[1].youngs_modulus = 0; }, "youngs_modulus");
  refuses([](DemScene& s) { s.materials.all[0].poissons_ratio = 0.6; }, "poissons_ratio");
  refuses([](DemScene& s) { s.materials.pairs[0].adhesion = -1; }, "adhesion");
}

}  // namespace
}  // namespace sluice
