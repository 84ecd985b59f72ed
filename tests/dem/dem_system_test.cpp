#include "dem/dem_system.h"

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

constexpr double g = 9.81;

/// A loose cubic block of n^3 spheres with random speeds and sizes.
void fill_block(DemSystem& dem, int n, const Vec3& corner, double small, double large, double speed,
                std::uint64_t seed, int shapes = 1) {
  Random random(seed);
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        NewRock rock;
        rock.size = random.uniform(small, large);
        rock.x = corner + (shapes > 1 ? 1.6 : 1.0) * large * Vec3(i + 0.5, j + 0.5, k + 0.5);
        rock.v = speed * random.on_sphere();
        rock.w = 5 * random.on_sphere();
        rock.q = random.rotation();
        rock.shape = static_cast<int>(dem.rocks().count() % static_cast<std::size_t>(shapes));
        dem.add(rock);
      }
}

DemScene gas_scene(double restitution, double friction) {
  DemScene scene = scene_of({restitution, friction, 0}, 0.02);
  scene.smallest_size = 0.01;
  scene.gravity = Vec3::Zero();
  return scene;
}

Vec3 angular_momentum_of(const DemSystem& dem) {
  Vec3 sum = Vec3::Zero();
  const Rocks& r = dem.rocks();
  for (std::size_t i = 0; i < r.count(); ++i)
    sum += r.mass[i] * r.x[i].cross(r.v[i]) +
           r.q[i] * Vec3(dem.inertia(i).cwiseProduct(r.q[i].conjugate() * r.w[i]));
  return sum;
}

double total(const DemEnergy& e) {
  return e.kinetic + e.elastic + e.potential + e.dissipated_normal + e.dissipated_friction - e.wall_work -
         e.fluid_work;
}

TEST(TwoSpheres, ReboundWithTheRestitutionAskedFor) {
  for (EndOfContact end : {EndOfContact::no_tension, EndOfContact::tension}) {
    DemConfig config;
    config.end_of_contact = end;
    config.steps_per_contact = 2000;
    DemScene scene = gas_scene(0.5, 0.4);
    const Walls none;
    DemSystem dem(config, scene, none);
    dem.add({.x = {0, 0, 0}, .v = {2, 0, 0}, .size = 0.02});
    dem.add({.x = {0.01501, 0, 0}, .v = {-1, 0, 0}, .size = 0.01});
    run(dem, 0.01);
    EXPECT_NEAR(dem.rocks().v[1].x() - dem.rocks().v[0].x(), 1.5, 2e-3);
    EXPECT_EQ(dem.contact_count(), 0u);
  }
}

TEST(ManySpheres, KeepMomentumAndEnergyToRoundingAndSecondOrder) {
  DemConfig config;
  config.steps_per_contact = 300;
  const Walls none;
  DemSystem dem(config, gas_scene(0.6, 0.5), none);
  fill_block(dem, 6, Vec3::Zero(), 0.01, 0.02, 2, 7);
  const Vec3 p = dem.momentum(), l = angular_momentum_of(dem);
  const double before = total(dem.energy());
  run(dem, 0.02);
  const DemEnergy after = dem.energy();
  double scale = 0;
  for (std::size_t i = 0; i < dem.rocks().count(); ++i) scale += dem.rocks().mass[i] * 2;
  EXPECT_LT((dem.momentum() - p).norm(), 1e-13 * scale);
  EXPECT_LT((angular_momentum_of(dem) - l).norm(), 1e-13 * scale);
  EXPECT_GT(after.dissipated_normal, 0.05 * before);
  EXPECT_GT(after.dissipated_friction, 0);
  EXPECT_NEAR(total(after), before, 2e-3 * before);
}

TEST(ManySpheres, GiveTheSameBitsWithAnyNumberOfThreads) {
  const int threads = thread_count();
  std::uint64_t expected = 0;
  for (int n : {1, 2, 3}) {
    set_thread_count(n);
    const Walls walls = walls_of(plane_wall(1, 5));
    DemScene scene = scene_of({0.3, 0.5, 0.05}, 0.02, {make_sphere(), make_superquadric(1.5, 0.8, 3)});
    scene.smallest_size = 0.01;
    DemSystem dem({}, scene, walls);
    fill_block(dem, 9, Vec3(-0.1, -0.1, 0), 0.01, 0.02, 5, 3);
    run(dem, 250 * dem.step_size());
    EXPECT_GT(dem.overlap_max(), 0.1);
    if (n == 1) expected = dem.state_hash();
    EXPECT_EQ(dem.state_hash(), expected);
  }
  set_thread_count(threads);
}

TEST(SeveralSteps, GiveTheBitsOfOneAfterTheOther) {
  for (const int shapes : {1, 2}) {
    const Walls walls = walls_of(plane_wall(1, 3));
    DemScene scene = scene_of({0.3, 0.5, 0.05}, 0.02, {make_sphere(), make_superquadric(1.5, 0.8, 8)});
    if (shapes == 1) scene.shapes.pop_back();
    scene.smallest_size = 0.01;
    DemSystem alone({}, scene, walls), together({}, scene, walls);
    for (DemSystem* dem : {&alone, &together})
      fill_block(*dem, 9, Vec3(-0.1, -0.1, 0), 0.01, 0.02, 8, 5, shapes);
    const double dt = alone.step_size();
    for (int k = 0; k < 300; ++k) {
      if (k % 7 == 0) together.steps(k * dt, dt, std::min(7, 300 - k));
      alone.step(k * dt, dt);
    }
    EXPECT_GT(alone.overlap_max(), 0.1);
    EXPECT_EQ(alone.state_hash(), together.state_hash());
    EXPECT_EQ(alone.energy().kinetic, together.energy().kinetic);
    EXPECT_EQ(alone.energy().dissipated_friction, together.energy().dissipated_friction);
    EXPECT_EQ(alone.wall_loads()[0].impulse, together.wall_loads()[0].impulse);
  }
}

TEST(StepOfNoTime, FindsTheForcesOnRocksThatTouchAndMovesNone) {
  const Walls none;
  DemScene scene = scene_of({0.3, 1, 0}, 0.02);
  scene.gravity = Vec3::Zero();
  DemSystem primed({}, scene, none), cold({}, scene, none);
  for (DemSystem* dem : {&primed, &cold})
    for (const double x : {0.0, 0.0199}) dem->add({.x = {x, 0, 0}, .size = 0.02});
  primed.step(0, 0);
  EXPECT_EQ(primed.contact_count(), 1u);
  EXPECT_EQ(primed.rocks().x[1], Vec3(0.0199, 0, 0));
  EXPECT_EQ(primed.energy().kinetic, 0);
  // the first kick of half a step then knows of the contact
  const double dt = 0.01 * primed.step_size();
  for (DemSystem* dem : {&primed, &cold}) dem->step(0, dt);
  EXPECT_GT(cold.rocks().v[1].x(), 0);
  EXPECT_NEAR(primed.rocks().v[1].x() / cold.rocks().v[1].x(), 2, 1e-3);
}

TEST(StepOfNoTime, IsRefusedWhereWallsMove) {
  Wall floor = plane_wall(0.3, 3);
  floor.motion.emplace();
  floor.motion->stroke = 0.001;
  floor.motion->frequency = 10;
  const Walls walls = walls_of(floor);
  DemSystem dem({}, scene_of({0.3, 0.5, 0}, 0.02), walls);
  EXPECT_THROW(dem.step(0, 0), std::invalid_argument);
}

TEST(StepOfNegativeTime, IsRefused) {
  const Walls none;
  DemSystem dem({}, scene_of({0.3, 0.5, 0}, 0.02), none);
  for (const double dt : {-1e-5, std::nan("")}) EXPECT_THROW(dem.step(0, dt), std::invalid_argument);
}

TEST(StateExchange, ContinuesBitForBit) {
  const Walls walls = walls_of(plane_wall(1, 3));
  DemScene scene = scene_of({0.3, 0.5, 0.05}, 0.02, {make_sphere(), make_superquadric(1.5, 0.8, 3)});
  scene.smallest_size = 0.01;
  DemSystem first({}, scene, walls);
  fill_block(first, 7, Vec3(-0.1, -0.1, 0), 0.01, 0.02, 8, 5, 2);  // more than a chunk: they are sorted
  const double dt = first.step_size();
  run(first, 250 * dt);
  MemoryArchive archive;
  first.exchange(archive);
  archive.rewind_to_load();
  DemSystem second({}, scene, walls);
  second.exchange(archive);
  EXPECT_EQ(second.state_hash(), first.state_hash());
  EXPECT_EQ(second.overlap_max(), first.overlap_max());
  EXPECT_EQ(second.energy().elastic, first.energy().elastic);
  for (int k = 250; k < 700; ++k)
    for (DemSystem* dem : {&first, &second}) {
      if (k == 400) {
        const std::vector<std::size_t> gone{3, 17, 40};
        dem->remove(gone);
        dem->add({.x = {0, 0, 0.5}, .size = 0.015});
      }
      dem->step(k * dt, dt);
    }
  EXPECT_EQ(second.state_hash(), first.state_hash());
  EXPECT_GT(first.overlap_max(), 0.1);
  EXPECT_GT(first.wall_loads()[0].impact_energy, 0);
  EXPECT_EQ(second.wall_loads()[0].impulse, first.wall_loads()[0].impulse);
  EXPECT_EQ(second.overlap_mean(), first.overlap_mean());
  EXPECT_EQ(second.rocks().id.back(), first.rocks().id.back());
}

TEST(Removal, KeepsTheOrderAndTheMotionOfTheOthers) {
  const Walls walls = walls_of(plane_wall(1));
  DemSystem whole({}, scene_of({0.3, 0.5, 0}, 0.02), walls), part({}, scene_of({0.3, 0.5, 0}, 0.02), walls);
  for (DemSystem* dem : {&whole, &part}) {
    dem->add({.x = {0, 0, 0.0099}, .size = 0.02});
    dem->add({.x = {0.5, 0, 0.0099}, .size = 0.02});
    dem->add({.x = {0.0199, 0, 0.0099}, .v = {0, 0.1, 0}, .size = 0.02});
    dem->add({.x = {0.0398, 0, 0.0099}, .size = 0.02});
    run(*dem, 20 * dem->step_size());
  }
  const std::vector<std::size_t> gone{1};
  const std::vector<RemovedRock> removed = part.remove(gone);
  ASSERT_EQ(removed.size(), 1u);
  EXPECT_EQ(removed[0].id, 1u);
  EXPECT_EQ(removed[0].mass, whole.rocks().mass[1]);
  EXPECT_EQ(part.rocks().id, (std::vector<std::uint64_t>{0, 2, 3}));
  run(whole, 500 * whole.step_size());
  run(part, 500 * part.step_size());
  for (std::size_t i : {0u, 1u, 2u}) {
    const std::size_t j = i == 0 ? 0 : i + 1;
    EXPECT_EQ(part.rocks().x[i], whole.rocks().x[j]);
    EXPECT_EQ(part.rocks().w[i], whole.rocks().w[j]);
  }
}

TEST(PeriodicAxis, MakesRocksMeetThroughIt) {
  DemScene scene = gas_scene(0.999, 0);
  scene.domain.box = {Vec3(0, -1, -1), Vec3(0.2, 1, 1)};
  scene.domain.low[0] = scene.domain.high[0] = Face::periodic;
  const Walls none;
  DemSystem dem({}, scene, none);
  dem.add({.x = {0.005, 0, 0}, .v = {-1, 0, 0}, .size = 0.02});
  dem.add({.x = {0.17, 0, 0}, .size = 0.02});
  run(dem, 0.05);
  EXPECT_GE(dem.rocks().x[0].x(), 0);
  EXPECT_LT(dem.rocks().x[0].x(), 0.2);
  EXPECT_NEAR(dem.rocks().v[1].x(), -1, 5e-3);
  EXPECT_NEAR(dem.rocks().v[0].x(), 0, 5e-3);
  EXPECT_TRUE(dem.remove_outside().empty());
  EXPECT_FALSE(dem.has_room(dem.rocks().x[1] + Vec3(0.19, 0, 0), 0.005, true));
}

TEST(PeriodicAxis, MayBeLittleWiderThanTwoRocks) {
  DemScene scene = gas_scene(0.999, 0);
  scene.smallest_size = 0.02;
  scene.domain.box = {Vec3(0, -1, -1), Vec3(0.042, 1, 1)};
  scene.domain.low[0] = scene.domain.high[0] = Face::periodic;
  const Walls none;
  DemSystem dem({}, scene, none);
  // Fast enough for the widest margin; they meet on one side, and on the other they do not.
  dem.add({.x = {0.001, 0, 0}, .v = {3, 0, 0}, .size = 0.02});
  dem.add({.x = {0.001 + 0.0199, 0, 0}, .v = {3, 0, 0}, .size = 0.02});
  dem.step(0, dem.step_size());
  EXPECT_EQ(dem.contact_count(), 1u);
  const Vec3 before = dem.momentum();
  run(dem, 2000 * dem.step_size());
  EXPECT_LT((dem.momentum() - before).norm(), 1e-12 * before.norm());

  scene.domain.box.hi.x() = 0.041;
  EXPECT_THROW(DemSystem({}, scene, none), InputError);
}

TEST(NeighbourList, MissesNoContactOverASizeRangeOfTen) {
  DemScene scene = gas_scene(0.5, 0.5);
  scene.smallest_size = 0.01;
  scene.largest_size = 0.1;
  scene.domain.box = {Vec3::Zero(), Vec3::Constant(0.6)};
  scene.domain.low[1] = scene.domain.high[1] = Face::periodic;
  const Walls none;
  DemConfig config;
  config.overlap_limit = 1;
  DemSystem dem(config, scene, none);
  Random random(11);
  for (int i = 0; i < 1500; ++i) {
    NewRock rock{.x = {random.uniform(0, 0.6), random.uniform(0, 0.6), random.uniform(0, 0.6)}};
    rock.size = i % 50 == 0 ? 0.1 : random.uniform(0.01, 0.03);
    if (dem.has_room(rock.x, 0.48 * rock.size, false)) dem.add(rock);
  }
  dem.step(0, 1e-9);
  std::size_t touching = 0;
  const Rocks& r = dem.rocks();
  for (std::size_t i = 0; i < r.count(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      touching += scene.domain.nearest_image(r.x[i] - r.x[j]).norm() < r.radius[i] + r.radius[j];
  EXPECT_GT(r.count(), 500u);
  EXPECT_GT(touching, 10u);
  EXPECT_EQ(dem.contact_count(), touching);
}

TEST(Room, IsTakenByRocksOldAndNewAndByWalls) {
  const Walls walls = walls_of(plane_wall(1));
  DemSystem dem({}, scene_of({0.3, 0.5, 0}, 0.02), walls);
  EXPECT_TRUE(dem.has_room({0, 0, 0.5}, 0.01, true));
  dem.add({.x = {0, 0, 0.5}, .size = 0.02});
  EXPECT_FALSE(dem.has_room({0, 0.019, 0.5}, 0.01, true));
  EXPECT_TRUE(dem.has_room({0, 0.0201, 0.5}, 0.01, true));
  run(dem, 10 * dem.step_size());
  EXPECT_FALSE(dem.has_room({0, 0.019, 0.5}, 0.01, true));
  EXPECT_FALSE(dem.has_room({0.3, 0, 0.009}, 0.01, true));
  EXPECT_TRUE(dem.has_room({0.3, 0, 0.009}, 0.01, false));
}

TEST(FluidForce, IsHeldAndItsImpulseAndWorkCounted) {
  DemScene scene = gas_scene(0.5, 0.5);
  const Walls none;
  DemSystem dem({}, scene, none);
  dem.add({.size = 0.02});
  const std::vector<Vec3> force{{0.02, 0, 0}}, torque{{0, 0, 1e-5}};
  dem.set_fluid_force(force, torque);
  run(dem, 1000 * dem.step_size());
  dem.add({.x = {1, 1, 1}, .size = 0.02});
  const double t = 1000 * dem.step_size(), m = dem.rocks().mass[0];
  EXPECT_NEAR(dem.rocks().v[0].x(), 0.02 * t / m, 1e-12);
  EXPECT_NEAR(dem.impulse_from_fluid().x(), 0.02 * t, 1e-15);
  EXPECT_NEAR(dem.rocks().w[0].z(), 1e-5 * t / dem.inertia(0).z(), 1e-9);
  EXPECT_NEAR(dem.energy().fluid_work, dem.energy().kinetic, 1e-9 * dem.energy().kinetic);
  dem.step(t, dem.step_size());
  EXPECT_EQ(dem.rocks().v[1], Vec3::Zero());
}

TEST(Gravity, GivesExactlyItsImpulse) {
  const Walls none;
  DemSystem dem({}, scene_of({0.3, 0.5, 0}, 0.02), none);
  dem.add({.size = 0.02});
  run(dem, 0.1);
  EXPECT_LT((dem.momentum() - dem.impulse_from_gravity()).norm(), 1e-14);
  EXPECT_LT(dem.momentum().z(), -0.9 * g * 0.1 * dem.rocks().mass[0]);
}

TEST(SpheresOnly, HoldNothingForSuperquadricsOrWalls) {
  const Walls none;
  DemSystem spheres({}, gas_scene(0.5, 0.5), none);
  DemScene mixed_scene = gas_scene(0.5, 0.5);
  mixed_scene.shapes.push_back(make_superquadric(1, 1, 4));
  DemSystem mixed({}, mixed_scene, none);
  for (DemSystem* dem : {&spheres, &mixed}) {
    fill_block(*dem, 10, Vec3::Zero(), 0.019, 0.02, 0.1, 1);
    dem->step(0, dem->step_size());
  }
  EXPECT_GT(mixed.memory_bytes(), spheres.memory_bytes() + 1000 * sizeof(Vec3));
  MemoryArchive archive;
  spheres.exchange(archive);
  archive.rewind_to_load();
  std::vector<Vec3> angular(7);
  archive.enter("rocks");
  archive.values("angular_momentum", angular);
  EXPECT_TRUE(angular.empty());
}

TEST(OverlapLimit, StopsTheRunAndNamesRockAndKnob) {
  const Walls none;
  DemSystem dem({}, gas_scene(0.5, 0.5), none);
  dem.add({.size = 0.02});
  dem.add({.x = {0.012, 0, 0}, .size = 0.02});
  try {
    dem.step(1.5, dem.step_size());
    FAIL() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_EQ(error.stage(), "rocks.substeps");
    EXPECT_EQ(error.time(), 1.5);
    EXPECT_NE(std::string(error.what()).find("rock 0 overlap is 0.8 radius (limit 0.3)"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("stiffness_per_size"), std::string::npos);
  }
}

TEST(BadInput, IsRefusedWithTheReason) {
  const Walls none;
  const auto refuses = [&](auto change, const char* word) {
    DemScene scene = gas_scene(0.5, 0.5);
    change(scene);
    try {
      DemSystem dem({}, scene, none);
      ADD_FAILURE() << "accepted: " << word;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  refuses([](DemScene& s) { s.smallest_size = 0; }, "size");
  refuses([](DemScene& s) { s.densest = 0; }, "density");
  refuses([](DemScene& s) { s.shapes[0].blockiness = 1.5; }, "blockiness");
  refuses([](DemScene& s) { s.shapes[0].semi_axes.z() = 0; }, "semi-axis");
  refuses([](DemScene& s) { s.shapes.clear(); }, "shapes");
  refuses([](DemScene& s) { s.materials.pairs[0].restitution = 0; }, "restitution");
  refuses([](DemScene& s) { s.materials.pairs[0].friction = -1; }, "friction");
  refuses([](DemScene& s) { s.materials.pairs.pop_back(); }, "pairs");
  refuses(
      [](DemScene& s) {
        s.domain.box = {Vec3::Zero(), Vec3::Constant(0.03)};
        s.domain.low[0] = s.domain.high[0] = Face::periodic;
      },
      "domain");
  DemSystem dem({}, gas_scene(0.5, 0.5), none);
  EXPECT_THROW(dem.add({.size = 0}), InputError);
  EXPECT_THROW(dem.add({.material = 1, .size = 0.02}), InputError);  // steel has no density
  EXPECT_THROW(dem.add({.shape = 4, .size = 0.02}), InputError);
}

}  // namespace
}  // namespace sluice
