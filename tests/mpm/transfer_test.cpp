#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "base/memory_archive.h"
#include "base/parallel.h"
#include "mpm/water_scenes.h"

namespace sluice {
namespace {

constexpr double h = 0.02;
const Vec3 gravity(0, 0, -9.81);

MpmConfig small_config(Precision precision) {
  MpmConfig config;
  config.spacing = h;
  config.fastest_bulk_speed = 2;
  config.precision = precision;
  return config;
}

/// A cube of water that spins, shears and falls.
std::unique_ptr<FluidSystem> tumbling_blob(Precision precision, const Walls& walls) {
  auto water = make_mpm(small_config(precision), open_box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), gravity, walls);
  WaterFill fill;
  fill.box = {Vec3(0.1, -0.2, 0.3), Vec3(0.26, -0.04, 0.46)};
  fill.jitter = 0.25;
  const Vec3 centre = fill.box.centre();
  fill.velocity = [centre](const Vec3& x) {
    return Vec3(Vec3(0.3, -0.2, 0.5) + Vec3(1, 2, 3).cross(x - centre) + Vec3(2 * (x - centre).z(), 0, 0));
  };
  fill_with_water(*water, h / 2, fill);
  return water;
}

class FreeFall : public ::testing::TestWithParam<Precision> {};

TEST_P(FreeFall, KeepsMomentumToRounding) {
  const Walls walls;
  const auto water = tumbling_blob(GetParam(), walls);
  const Vec3 before = water->momentum();
  const double dt = water->limits().step;
  double path = before.norm();
  for (int n = 0; n < 100; ++n) {
    step_water(*water, n * dt, dt);
    path += water->total_mass() * gravity.norm() * dt;
  }
  const double tolerance = GetParam() == Precision::reference ? 1e-12 : 1e-6;
  EXPECT_LT((water->momentum() - before - water->impulse_from_gravity()).norm(), tolerance * path);
  EXPECT_NEAR(water->impulse_from_gravity().z(), water->total_mass() * gravity.z() * dt * 100, 1e-6 * path);
}

TEST_P(FreeFall, AsOneSpeedLeavesTheShapeAlone) {
  const Walls walls;
  auto water = make_mpm(small_config(GetParam()), open_box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), gravity, walls);
  WaterFill fill;
  fill.box = {Vec3(0, 0, 0), Vec3(0.1, 0.1, 0.1)};
  fill.velocity = [](const Vec3&) { return Vec3(1.0, -0.5, 1.5); };
  fill_with_water(*water, h / 2, fill);
  const WaterPoints before = water->points();
  const double dt = water->limits().step;
  const int steps = 200;
  for (int n = 0; n < steps; ++n) step_water(*water, n * dt, dt);
  const WaterPoints after = water->points();
  const double t = steps * dt;
  // Semi-implicit Euler: v first, then x.
  const Vec3 moved = t * Vec3(1.0, -0.5, 1.5) + 0.5 * gravity * t * (t + dt);
  double worst = 0;
  for (std::size_t i = 0; i < after.count(); ++i)
    worst = std::max(worst, (after.x[i] - before.x[i] - moved).norm());
  EXPECT_LT(worst, 5e-3 * h);  // points are spread evenly as they pass the grid
  // Nothing stretches it, to the rounding of single precision.
  EXPECT_LT(*std::max_element(after.J.begin(), after.J.end()), 1 + 1e-7);
}

INSTANTIATE_TEST_SUITE_P(InBothPrecisions, FreeFall,
                         ::testing::Values(Precision::single, Precision::reference),
                         [](const auto& p) { return p.param == Precision::single ? "Single" : "Reference"; });

TEST(AngularMomentum, OfASpinningBlobIsKept) {
  const Walls walls;
  auto water = make_mpm(small_config(Precision::reference), open_box(Vec3(-1, -1, -1), Vec3(1, 1, 1)),
                        Vec3::Zero(), walls);
  WaterFill fill;
  fill.box = {Vec3(-0.1, -0.1, -0.1), Vec3(0.1, 0.1, 0.1)};
  fill.velocity = [](const Vec3& x) { return Vec3(Vec3(1, 2, 3).cross(x)); };
  fill_with_water(*water, h / 2, fill);
  const double dt = water->limits().step;
  Vec3 before = Vec3::Zero();
  for (int n = 0; n < 220; ++n) {
    if (n == 20) before = angular_momentum(*water);  // the points' own spin has settled
    step_water(*water, n * dt, dt);
  }
  EXPECT_LT((angular_momentum(*water) - before).norm(), 0.02 * before.norm());
}

TEST(WaterMass, IsKeptToTheLastBit) {
  const Walls walls;
  const auto water = tumbling_blob(Precision::single, walls);
  NewPoint odd;
  odd.x = Vec3(0, 0, 0);
  odd.mass = 0.1234567890123456;
  odd.fines_mass = 0.0123456789012345;
  const std::uint64_t id = water->add(odd);
  const double dt = water->limits().step;
  for (int n = 0; n < 20; ++n) step_water(*water, n * dt, dt);
  const auto removed = water->remove_if([](const Vec3&, const Vec3& now) { return now.z() < 0.1; });
  ASSERT_EQ(removed.size(), 1U);
  EXPECT_EQ(removed[0].id, id);
  EXPECT_EQ(removed[0].mass, odd.mass);
  EXPECT_EQ(removed[0].fines_mass, odd.fines_mass);
  EXPECT_EQ(water->total_fines(), 0.0);
}

std::uint64_t hash_after(int threads, int steps) {
  const int before = thread_count();
  set_thread_count(threads);
  const Walls walls;
  const auto water = tumbling_blob(Precision::single, walls);
  const double dt = water->limits().step;
  for (int n = 0; n < steps; ++n) step_water(*water, n * dt, dt);
  set_thread_count(before);
  return water->state_hash();
}

TEST(WaterState, IsTheSameForAnyNumberOfThreads) {
  const std::uint64_t one = hash_after(1, 150);
  EXPECT_EQ(hash_after(2, 150), one);
  EXPECT_EQ(hash_after(3, 150), one);
  EXPECT_NE(hash_after(1, 151), one);
}

TEST(WaterState, GoesOnBitForBitFromASavedState) {
  const Walls walls;
  const auto whole = tumbling_blob(Precision::single, walls);
  const double dt = whole->limits().step;
  MemoryArchive archive;
  for (int n = 0; n < 200; ++n) {
    if (n == 90) whole->exchange(archive);
    if (n % 7 == 0)
      whole->remove_if(
          [](const Vec3& before, const Vec3& now) { return before.x() > 0.25 && now.x() > before.x(); });
    step_water(*whole, n * dt, dt);
  }
  auto rest =
      make_mpm(small_config(Precision::single), open_box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), gravity, walls);
  archive.rewind_to_load();
  rest->exchange(archive);
  for (int n = 90; n < 200; ++n) {
    if (n % 7 == 0)
      rest->remove_if(
          [](const Vec3& before, const Vec3& now) { return before.x() > 0.25 && now.x() > before.x(); });
    step_water(*rest, n * dt, dt);
  }
  EXPECT_EQ(rest->state_hash(), whole->state_hash());
  EXPECT_EQ(rest->total_mass(), whole->total_mass());
  EXPECT_EQ(rest->momentum_removed(), whole->momentum_removed());
}

TEST(WaterPath, BeforeIsWhereThePointWasAStepAgo) {
  const Walls walls;
  const auto water = tumbling_blob(Precision::single, walls);
  const double dt = water->limits().step;
  const int threads = thread_count();
  for (int n = 0; n < 50; ++n) {
    std::vector<Vec3> last = water->points().x;
    step_water(*water, n * dt, dt);
    std::vector<Vec3> before;
    set_thread_count(1);
    water->remove_if([&](const Vec3& b, const Vec3&) {
      before.push_back(b);
      return false;
    });
    set_thread_count(threads);
    const auto less = [](const Vec3& a, const Vec3& b) {
      return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    };
    std::sort(last.begin(), last.end(), less);
    std::sort(before.begin(), before.end(), less);
    double worst = 0;
    for (std::size_t i = 0; i < last.size(); ++i) worst = std::max(worst, (last[i] - before[i]).norm());
    ASSERT_LT(worst, 1e-12);
  }
}

TEST(Spray, InFreeFlightKeepsEachPointsVelocity) {
  const Walls walls;
  for (const Precision precision : {Precision::single, Precision::reference}) {
    auto water = make_mpm(small_config(precision), open_box(Vec3(-2, -2, -4), Vec3(2, 2, 2)), gravity, walls);
    Random random(3);
    std::vector<Vec3> start;
    for (int n = 0; n < 216; ++n) {  // stencils overlap, cells are about 7 % full
      NewPoint p;
      p.x = 1.2 * h * Vec3(n % 6, n / 6 % 6, n / 36);
      p.v = Vec3(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-1.1, -0.9));
      p.mass = 1e-3;
      start.push_back(p.v);
      water->add(p);
    }
    const double dt = water->limits().step;
    const int steps = 100;
    for (int n = 0; n < steps; ++n) step_water(*water, n * dt, dt);
    const WaterPoints after = water->points();
    double worst = 0;
    for (std::size_t i = 0; i < after.count(); ++i)
      worst = std::max(worst, (after.v[i] - start[i] - steps * dt * gravity).norm());
    EXPECT_LT(worst, precision == Precision::reference ? 1e-10 : 1e-4);
  }
}

TEST(Water, WithASpeedBeyondItsReachStopsTheRunAndNamesTheKey) {
  const Walls walls;
  auto water =
      make_mpm(small_config(Precision::single), open_box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), gravity, walls);
  NewPoint p;
  p.mass = 1e-3;
  p.v = Vec3(60, 0, 0);
  water->add(p);
  try {
    step_water(*water, 0, water->limits().step);
    FAIL() << "no error";
  } catch (const NumericalError& e) {
    EXPECT_EQ(e.stage(), "water.grid_to_points");
    EXPECT_NE(std::string(e.what()).find("fastest_speed"), std::string::npos) << e.what();
  }
}

TEST(Water, ThatIsNotFiniteIsRefused) {
  const Walls walls;
  auto water =
      make_mpm(small_config(Precision::single), open_box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), gravity, walls);
  NewPoint p;
  p.mass = 1e-3;
  p.v = Vec3(std::nan(""), 0, 0);
  EXPECT_THROW(water->add(p), NumericalError);
  p.v = Vec3::Zero();
  p.x = Vec3(5, 0, 0);
  EXPECT_THROW(water->add(p), NumericalError);
}

TEST(WaterGrid, RefusesAPeriodicLengthThatIsNoMultipleOfTheSpacing) {
  const Walls walls;
  Domain domain = open_box(Vec3::Zero(), Vec3(0.21, 0.2, 0.2));
  make_periodic(domain, 0);
  EXPECT_THROW(make_mpm(small_config(Precision::single), domain, gravity, walls), InputError);
}

// Taylor & Green (1937): the kinetic energy of the 2D vortex falls as exp(-4 nu k^2 t).
TEST(TaylorGreen, DecaysWithTheViscosityOfTheWater) {
  constexpr double pi = std::numbers::pi;
  const Walls walls;
  const int cells = 32;
  const double length = 1, speed = 1;
  Domain domain = open_box(Vec3::Zero(), Vec3(length, length, 3 * length / cells));
  for (int axis = 0; axis < 3; ++axis) make_periodic(domain, axis);
  MpmConfig config;
  config.spacing = length / cells;
  config.fastest_bulk_speed = speed;
  config.keep_tension = true;
  config.fluid.viscosity = config.fluid.density * speed * length / 100;  // Re = 100
  auto water = make_mpm(config, domain, Vec3::Zero(), walls);
  const double k = 2 * pi / length;
  const double c = water->limits().sound_speed;
  WaterFill fill;
  fill.box = domain.box;
  fill.jitter = 0.1;
  fill.velocity = [&](const Vec3& x) {
    return Vec3(speed * std::cos(k * x.x()) * std::sin(k * x.y()),
                -speed * std::sin(k * x.x()) * std::cos(k * x.y()), 0);
  };
  fill.J = [&](const Vec3& x) {  // p = -rho U2/4 (cos 2kx + cos 2ky)
    return 1 + speed * speed / (4 * c * c) * (std::cos(2 * k * x.x()) + std::cos(2 * k * x.y()));
  };
  fill_with_water(*water, config.spacing / 2, fill);
  const double dt = water->limits().step;
  const int start = static_cast<int>(0.05 / dt), steps = static_cast<int>(0.3 / dt);
  double first = 0;
  for (int n = 0; n < steps; ++n) {
    if (n == start) first = water->kinetic_energy();
    step_water(*water, n * dt, dt);
  }
  const double rate = std::log(first / water->kinetic_energy()) / ((steps - start) * dt);
  const double exact = 4 * config.fluid.viscosity / config.fluid.density * k * k;
  EXPECT_NEAR(rate / exact, 1.0, 0.15);
}

}  // namespace
}  // namespace sluice
