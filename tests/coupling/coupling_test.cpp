#include "coupling/coupling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/random.h"
#include "coupling/node_fluid.h"

namespace sluice {
namespace {

const Vec3 gravity(0, 0, -9.81);

Domain open_box(double side) {
  Domain d;
  d.box = {Vec3::Zero(), Vec3::Constant(side)};
  return d;
}

struct Scene {
  Scene(double side, double spacing, const Vec3& v_water, double size, double density, CouplingConfig config,
        const Box* water = nullptr)
      : domain(open_box(side)), fluid(water ? *water : domain.box, spacing, v_water) {
    DemScene scene;
    scene.materials.all = {{"rock", density}};
    scene.materials.pairs = {PairProperties{}};
    scene.shapes = {make_sphere(), make_superquadric(1.4, 0.7, 4)};
    scene.domain = domain;
    scene.gravity = gravity;
    scene.smallest_size = std::min(size, 0.01);
    scene.largest_size = std::max(size, 0.25);
    scene.densest = density;
    rocks = std::make_unique<DemSystem>(DemConfig{}, scene, walls);
    coupling = std::make_unique<Coupling>(config, domain, gravity, *rocks, fluid);
  }
  void add(const Vec3& x, const Vec3& v, double size, int shape = 0) {
    NewRock rock;
    rock.x = x;
    rock.v = v;
    rock.size = size;
    rock.shape = shape;
    rocks->add(rock);
  }
  void exchange(double dt) {
    coupling->solids_to_grid();
    coupling->drag(dt);
    coupling->fluid_to_grid(dt);
  }

  Walls walls;
  Domain domain;
  NodeFluid fluid;
  std::unique_ptr<DemSystem> rocks;
  std::unique_ptr<Coupling> coupling;
};

// Balance of weight, buoyancy and the selected law, solved by bisection.
double terminal_velocity(DragModel model, double d, double density, double rho, double mu) {
  const double weight = std::numbers::pi / 6 * d * d * d * (density - rho) * 9.81;
  double lo = 0, hi = 20;
  for (int i = 0; i < 200; ++i) {
    DragInput in;
    in.density = rho;
    in.viscosity = mu;
    in.diameter = d;
    in.speed = 0.5 * (lo + hi);
    (drag_per_speed(model, in) * in.speed < weight ? lo : hi) = in.speed;
  }
  return lo;
}

TEST(OneWayCoupling, BringsARockToTheTerminalVelocityOfItsLaw) {
  for (DragModel model : {DragModel::di_felice, DragModel::schiller_naumann}) {
    CouplingConfig config;
    config.mode = CouplingMode::one_way;
    config.drag = model;
    Scene scene(0.8, 0.05, Vec3::Zero(), 0.01, 2650, config);
    scene.add(Vec3(0.41, 0.39, 0.7), Vec3::Zero(), 0.01);
    const double dt = 2e-4;
    double t = 0;
    for (int i = 0; i < 2500 && scene.rocks->rocks().x[0].z() > 0.2; ++i, t += dt) {
      scene.exchange(dt);
      scene.rocks->step(t, dt);
    }
    EXPECT_NEAR(-scene.rocks->rocks().v[0].z(), terminal_velocity(model, 0.01, 2650, 1000, 1e-3),
                0.01 * terminal_velocity(model, 0.01, 2650, 1000, 1e-3));
    EXPECT_EQ(scene.fluid.impulse_.norm(), 0.0) << "one-way: the water must not feel the rock";
  }
}

TEST(TwoWayCoupling, HandsTheSameImpulseToBothSides) {
  Scene scene(1.0, 0.05, Vec3(0.7, -0.2, 0.3), 0.03, 2650, CouplingConfig{});
  Random random(11);
  for (int i = 0; i < 200; ++i)
    scene.add(Vec3(random.uniform(0.1, 0.9), random.uniform(0.1, 0.9), random.uniform(0.1, 0.9)),
              random.uniform(0.0, 3.0) * random.on_sphere(), random.uniform(0.01, 0.09), i % 2);
  double scale = 0;
  for (int step = 0; step < 20; ++step) {
    scene.exchange(1e-3);
    for (std::size_t r = 0; r < 200; ++r)
      scale += 1e-3 * (scene.coupling->drag_force()[r] + scene.coupling->buoyancy_force()[r]).norm();
  }
  EXPECT_GT(scale, 1.0);
  EXPECT_LT((scene.coupling->impulse_on_rocks() + scene.coupling->impulse_on_fluid()).norm(), 1e-12 * scale);
  EXPECT_LT((scene.fluid.impulse_ - scene.coupling->impulse_on_fluid()).norm(), 1e-12 * scale);
}

TEST(TwoWayCoupling, HasTheSameBitsForAnyNumberOfThreads) {
  const int before = thread_count();
  std::vector<Vec3> impulses[3];
  for (int threads : {1, 2, 3}) {
    set_thread_count(threads);
    Scene scene(2.0, 0.05, Vec3(0.7, -0.2, 0.3), 0.03, 2650, CouplingConfig{});
    Random random(11);
    for (int i = 0; i < 3000; ++i)
      scene.add(Vec3(random.uniform(0.1, 1.9), random.uniform(0.1, 1.9), random.uniform(0.1, 1.9)),
                random.uniform(0.0, 3.0) * random.on_sphere(), random.uniform(0.01, 0.09), i % 2);
    std::vector<Vec3>& impulse = impulses[threads - 1];
    for (int step = 0; step < 3; ++step) {
      scene.exchange(1e-3);
      impulse.insert(impulse.end(), scene.fluid.nodes_.v.begin(), scene.fluid.nodes_.v.end());
      const std::vector<Vec3>&drag = scene.coupling->drag_force(), &lift = scene.coupling->buoyancy_force();
      impulse.insert(impulse.end(), drag.begin(), drag.end());
      impulse.insert(impulse.end(), lift.begin(), lift.end());
    }
    impulse.push_back(scene.coupling->impulse_on_fluid());
  }
  set_thread_count(before);
  EXPECT_TRUE(impulses[0] == impulses[1]);
  EXPECT_TRUE(impulses[0] == impulses[2]);
}

TEST(TwoWayCoupling, NeverOverdrawsANodeHoweverManyRocksItHas) {
  CouplingConfig config;
  Scene scene(0.6, 0.05, Vec3::Zero(), 0.02, 8000, config);
  Random random(3);
  for (int i = 0; i < 400; ++i)
    scene.add(Vec3(0.3, 0.3, 0.3) + 0.08 * random.on_sphere(), Vec3(0, 0, -10), 0.02);
  scene.exchange(0.5);  // far beyond any stable explicit step
  for (const Vec3& v : scene.fluid.nodes_.v) {
    EXPECT_LT(v.z(), 10.0);  // buoyancy may push down, drag cannot overshoot
    EXPECT_GT(v.z(), -10.001);
  }
}

TEST(Buoyancy, CarriesTheDisplacedWeightInStillWater) {
  Scene scene(0.8, 0.05, Vec3::Zero(), 0.05, 2650, CouplingConfig{});
  scene.add(Vec3(0.41, 0.42, 0.43), Vec3::Zero(), 0.05);
  for (int i = 0; i < 400; ++i) {
    scene.exchange(1e-3);
    for (Vec3& v : scene.fluid.nodes_.v) v.setZero();  // held still, as by walls and pressure
  }
  const double weight = 1000 * scene.rocks->volume(0) * 9.81;
  EXPECT_NEAR(scene.coupling->buoyancy_force()[0].z(), weight, 1e-6 * weight);
  EXPECT_NEAR(scene.coupling->buoyancy_force()[0].x(), 0, 1e-9 * weight);
}

TEST(Buoyancy, IsNothingInFreeFall) {
  Scene scene(0.8, 0.05, Vec3::Zero(), 0.05, 2650, CouplingConfig{});
  scene.add(Vec3(0.41, 0.42, 0.43), Vec3::Zero(), 0.05);
  scene.fluid.acceleration_.assign(scene.fluid.nodes_.count(), gravity);
  for (int i = 0; i < 10; ++i) scene.exchange(1e-3);
  EXPECT_LT(scene.coupling->buoyancy_force()[0].norm(), 1e-12 * scene.rocks->rocks().mass[0] * 9.81);
}

TEST(PartlyWettedRock, FeelsNothingAboveAWetSheet) {
  const Box sheet{Vec3::Zero(), Vec3(1, 1, 0.1)};
  Scene scene(1.0, 0.02, Vec3(4, 0, 0), 0.1, 2650, CouplingConfig{}, &sheet);
  scene.add(Vec3(0.5, 0.5, 0.2), Vec3::Zero(), 0.1);  // lowest point 0.05 above the topmost node
  for (int i = 0; i < 10; ++i) scene.exchange(1e-3);
  EXPECT_EQ(scene.coupling->wetted_fraction()[0], 0.0);
  EXPECT_EQ(scene.coupling->drag_force()[0], Vec3(0, 0, 0));
  EXPECT_EQ(scene.coupling->buoyancy_force()[0], Vec3(0, 0, 0));
  EXPECT_EQ(scene.fluid.impulse_, Vec3(0, 0, 0));
}

TEST(PartlyWettedRock, IsHalfWetWhenHalfUnderWater) {
  const Box lower{Vec3::Zero(), Vec3(1, 1, 0.5)};
  CouplingConfig finer;
  finer.wetting_points = 128;
  Scene scene(1.0, 0.02, Vec3::Zero(), 0.2, 2650, finer, &lower);
  scene.add(Vec3(0.5, 0.5, 0.49), Vec3::Zero(), 0.2);  // nodes end at 0.48: full to 0.49
  scene.exchange(1e-3);
  EXPECT_NEAR(scene.coupling->wetted_fraction()[0], 0.5, 0.05);
}

TEST(VoidFraction, HoldsTheWettedVolumeOfTheRocks) {
  Scene scene(1.0, 0.05, Vec3::Zero(), 0.03, 2650, CouplingConfig{});
  Random random(5);
  double volume = 0;
  for (int i = 0; i < 50; ++i) {
    scene.add(Vec3(random.uniform(0.2, 0.8), random.uniform(0.2, 0.8), random.uniform(0.2, 0.8)),
              Vec3::Zero(), random.uniform(0.01, 0.06), i % 2);
    volume += scene.rocks->volume(static_cast<std::size_t>(i));
  }
  scene.exchange(1e-3);
  double displaced = 0;
  for (std::size_t n = 0; n < scene.fluid.nodes_.count(); ++n)
    displaced += (1 - scene.fluid.void_fraction_[n]) * scene.fluid.nodes_.open_volume[n];
  EXPECT_NEAR(displaced, volume, 1e-12 * volume);
}

TEST(CouplingGrid, GivesEveryRockAKernelOfTheStatedWidth) {
  Scene scene(2.0, 0.04, Vec3::Zero(), 0.02, 2650, CouplingConfig{});
  for (double size : {0.02, 0.05, 0.11, 0.2}) scene.add(Vec3(1, 1, 1), Vec3::Zero(), size);
  scene.exchange(1e-3);
  EXPECT_GE(scene.coupling->smallest_kernel_ratio(), 4 * (1 - 1e-9));
}

}  // namespace
}  // namespace sluice
