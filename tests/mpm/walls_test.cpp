/// Water and walls: standing water, thin sheets, lips, belts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "mpm/water_scenes.h"

namespace sluice {
namespace {

const Vec3 gravity(0, 0, -9.81);
constexpr double g = 9.81;
constexpr double rho = 1000;

/// A rectangle in the plane `axis` = at, over [lo, hi] of the other two axes.
Wall sheet(const std::string& name, int axis, double at, const Vec3& lo, const Vec3& hi) {
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  std::array<Vec3, 4> corners;
  for (int n = 0; n < 4; ++n) {
    Vec3& c = corners[static_cast<std::size_t>(n)];
    c[axis] = at;
    c[a] = n == 1 || n == 2 ? hi[a] : lo[a];
    c[b] = n >= 2 ? hi[b] : lo[b];
  }
  Wall wall;
  wall.name = name;
  wall.mesh = make_rectangle(name, corners);
  return wall;
}

/// J of water at rest under `depth` metres of itself.
double still_J(double depth, double sound_speed) {
  return depth > 0 ? 1 / (1 + g * depth / (sound_speed * sound_speed)) : 1.0;
}

/// A tank of 8 x 4 x 16 cells between end walls that stand `off` cells beside nodes, full of still water.
class StillTank : public ::testing::TestWithParam<double> {
 protected:
  void SetUp() override {
    const double thickness = 4 * h, beyond = 0.1;
    Domain domain =
        open_box(Vec3(-GetParam() * h - h, 0, -2 * h), Vec3(length + 2 * h, thickness, depth + 6 * h));
    make_periodic(domain, 1);
    std::vector<Wall> parts;
    const Vec3 lo(-beyond, -beyond, -beyond), hi(length + beyond, thickness + beyond, depth + beyond);
    parts.push_back(sheet("floor", 2, 0.0, lo, hi));
    parts.push_back(sheet("left", 0, 0.0, lo, hi));
    parts.push_back(sheet("right", 0, length, lo, hi));
    walls = std::make_unique<Walls>(std::move(parts));
    MpmConfig config;
    config.spacing = h;
    config.deepest = depth;
    config.fastest_bulk_speed = 0.5;
    config.wall_slip = WallSlip::slip;
    water = make_mpm(config, domain, gravity, *walls);
    WaterFill fill;
    fill.box = {Vec3::Zero(), Vec3(length, thickness, depth)};
    const double c = water->limits().sound_speed;
    fill.J = [&](const Vec3& x) { return still_J(depth - x.z(), c); };
    fill_with_water(*water, h / 2, fill);
  }
  static constexpr double depth = 0.5, h = depth / 16, length = 8 * h;
  std::unique_ptr<Walls> walls;
  std::unique_ptr<FluidSystem> water;
};

// Water far from a wall, that the spline of a node beside the wall still reaches, is no open side.
TEST_P(StillTank, PushesNothingOffItsWalls) {
  const double dt = water->limits().step;
  FluidNodes nodes;
  std::vector<Vec3> acceleration;
  water->points_to_grid(0, dt);
  water->read_nodes(nodes);
  water->walls(dt);
  water->read_accelerations(acceleration);
  ASSERT_EQ(nodes.count(), acceleration.size());
  double largest = 0;
  for (std::size_t n = 0; n < nodes.count(); ++n)
    if (nodes.x[n].z() > 2 * h && nodes.x[n].z() < depth - 2 * h)
      largest = std::max(largest, acceleration[n].norm());
  EXPECT_LT(largest, 0.01 * g);
}

TEST_P(StillTank, StaysStill) {
  const double dt = water->limits().step;
  for (double t = 0; t < 1.0; t += dt) step_water(*water, t, dt);
  EXPECT_LT(std::sqrt(2 * water->kinetic_energy() / water->total_mass()), 5e-3);
}

INSTANTIATE_TEST_SUITE_P(WallsOnNodesAndBeside, StillTank, ::testing::Values(0.0, 0.3, 0.5));

// A column of 4 x 4 x 32 cells, periodic sideways: after 1 s the bottom feels rho g H.
TEST(StillColumn, KeepsItsBottomPressure) {
  const double h = 0.5 / 32, depth = 0.5, width = 4 * h, thickness = 4 * h;
  Domain domain = open_box(Vec3(0, 0, -2 * h), Vec3(width, thickness, depth + 6 * h));
  make_periodic(domain, 0);
  make_periodic(domain, 1);

  std::vector<Wall> parts;
  parts.push_back(sheet("floor", 2, 0.0, Vec3(-0.1, -0.1, 0), Vec3(width + 0.1, thickness + 0.1, 0)));
  const Walls walls(std::move(parts));
  MpmConfig config;
  config.spacing = h;
  config.deepest = depth;
  config.fastest_bulk_speed = std::sqrt(g * depth);
  config.sound_speed = 10 * std::sqrt(g * depth);
  config.wall_slip = WallSlip::slip;
  auto water = make_mpm(config, domain, gravity, walls);
  WaterFill fill;
  fill.box = {Vec3(0, 0, 0), Vec3(width, thickness, depth)};
  fill.jitter = 0.1;
  fill.J = [&](const Vec3& x) { return still_J(depth - x.z(), *config.sound_speed); };
  fill_with_water(*water, h / 2, fill);
  const double dt = water->limits().step;
  const int steps = static_cast<int>(1.0 / dt);
  Vec3 early = Vec3::Zero();
  int early_step = 0;
  double mean_pressure = 0;
  int samples = 0;
  for (int n = 0; n < steps; ++n) {
    if (n == steps * 3 / 4) {
      early = water->wall_loads()[0].impulse;
      early_step = n;
    }
    step_water(*water, n * dt, dt);
    if (n > steps * 3 / 4 && n % 20 == 0) {
      const WaterPoints points = water->points();
      double sum = 0, weight = 0;
      for (std::size_t i = 0; i < points.count(); ++i) {
        if (points.x[i].z() > 2 * h) continue;
        sum += points.pressure[i] + rho * g * points.x[i].z();
        weight += 1;
      }
      mean_pressure += sum / weight;
      ++samples;
    }
  }
  const double force = -(water->wall_loads()[0].impulse - early).z() / ((steps - early_step) * dt);
  EXPECT_NEAR(force / (rho * g * depth * width * thickness), 1.0, 0.05);
  EXPECT_NEAR(mean_pressure / samples / (rho * g * depth), 1.0, 0.05);
  double top = 0, speed2 = 0;
  const WaterPoints points = water->points();
  for (std::size_t i = 0; i < points.count(); ++i) {
    top += 2 * points.x[i].z() / static_cast<double>(points.count());
    speed2 += points.v[i].squaredNorm() / static_cast<double>(points.count());
    ASSERT_GT(points.x[i].z(), 0.0);
    ASSERT_LE(points.J[i], 1.0);
  }
  EXPECT_NEAR(top / depth, 1.0, 0.01);  // twice the height of the centre of mass
  EXPECT_LT(std::sqrt(speed2), 0.02);
}

// Walls without friction carry none of the water's weight, wherever they stand to the grid: the floor has it
// all.
TEST(StillColumn, BetweenSlipperySidesRestsOnItsFloor) {
  const double depth = 0.5, h = depth / 16, width = 4 * h;
  for (const double shift : {0.0, 0.4}) {
    const Vec3 below(-(2 + shift) * h, -2 * h, -(2 + shift) * h);  // of the domain: a corner of the grid
    const Domain domain = open_box(below, Vec3(width + 2 * h, width + 2 * h, depth + 6 * h));
    std::vector<Wall> parts;
    const Vec3 lo(0, 0, 0), hi(width, width, depth + 4 * h);
    parts.push_back(sheet("floor", 2, 0.0, lo, hi));
    for (const int axis : {0, 1})
      for (const double at : {0.0, width})
        parts.push_back(sheet("side" + std::to_string(parts.size()), axis, at, lo, hi));
    const Walls walls(std::move(parts));
    MpmConfig config;
    config.spacing = h;
    config.deepest = depth;
    config.fastest_bulk_speed = std::sqrt(g * depth);
    config.sound_speed = 10 * std::sqrt(g * depth);
    config.wall_slip = WallSlip::slip;
    auto water = make_mpm(config, domain, gravity, walls);
    WaterFill fill;
    fill.box = {lo, Vec3(width, width, depth)};
    fill.jitter = 0.1;
    fill.J = [&](const Vec3& x) { return still_J(depth - x.z(), *config.sound_speed); };
    fill_with_water(*water, h / 2, fill);
    const double dt = water->limits().step;
    const int steps = static_cast<int>(0.5 / dt);
    double early = 0;
    for (int n = 0; n < steps; ++n) {
      if (n == steps / 2) early = water->wall_loads()[0].impulse.z();
      step_water(*water, n * dt, dt);
    }
    const double force = -(water->wall_loads()[0].impulse.z() - early) / ((steps - steps / 2) * dt);
    EXPECT_NEAR(force / (rho * g * depth * width * width), 1.0, 0.03) << "shifted by " << shift << " cells";
    EXPECT_LT(water->largest_speed(), 0.1) << "shifted by " << shift << " cells";  // no stream in corners
  }
}

struct SheetResult {
  double force_ratio = 0;
  std::size_t beyond = 0;
  double momentum_gap = 0;
};

/// 0.3 m of water against 0.15 m on the two sides of a sheet of no thickness.
SheetResult two_levels(double seconds) {
  const double h = 0.03, thickness = 3 * h, left = -0.24, right = 0.24, high = 0.3, low = 0.15;
  Domain domain = open_box(Vec3(left - 2 * h, 0, -2 * h), Vec3(right + 2 * h, thickness, 0.6));
  make_periodic(domain, 1);

  std::vector<Wall> parts;
  parts.push_back(sheet("sheet", 0, 0.0, Vec3(0, -0.2, -0.2), Vec3(0, thickness + 0.2, 0.6)));
  parts.push_back(sheet("floor", 2, 0.0, Vec3(left - 0.1, -0.2, 0), Vec3(right + 0.1, thickness + 0.2, 0)));
  parts.push_back(sheet("left", 0, left, Vec3(0, -0.2, -0.2), Vec3(0, thickness + 0.2, 0.6)));
  parts.push_back(sheet("right", 0, right, Vec3(0, -0.2, -0.2), Vec3(0, thickness + 0.2, 0.6)));
  const Walls walls(std::move(parts));
  MpmConfig config;
  config.spacing = h;
  config.deepest = high;
  config.fastest_bulk_speed = std::sqrt(g * high);
  config.sound_speed = 10 * std::sqrt(g * high);
  config.wall_slip = WallSlip::slip;
  auto water = make_mpm(config, domain, gravity, walls);
  const double c = water->limits().sound_speed;
  WaterFill fill;
  fill.jitter = 0.1;
  fill.box = {Vec3(left, 0, 0), Vec3(0, thickness, high)};
  fill.J = [&](const Vec3& x) { return still_J(high - x.z(), c); };
  fill_with_water(*water, h / 2, fill);
  const std::size_t first_right = water->count();
  fill.box = {Vec3(0, 0, 0), Vec3(right, thickness, low)};
  fill.J = [&](const Vec3& x) { return still_J(low - x.z(), c); };
  fill_with_water(*water, h / 2, fill);
  const double dt = water->limits().step;
  const int steps = static_cast<int>(seconds / dt);
  double before = 0;
  int from = 0;
  for (int n = 0; n < steps; ++n) {
    if (n == steps / 2) {
      before = water->wall_loads()[0].impulse.x();
      from = n;
    }
    step_water(*water, n * dt, dt);
  }
  SheetResult result;
  const double force = (water->wall_loads()[0].impulse.x() - before) / ((steps - from) * dt);
  result.force_ratio = force / (0.5 * rho * g * (high * high - low * low) * thickness);
  const WaterPoints points = water->points();
  for (std::size_t i = 0; i < points.count(); ++i) {
    const bool on_left = points.id[i] < first_right;
    const double x = points.x[i].x();
    if (on_left ? x >= 0 || x <= left : x <= 0 || x >= right) ++result.beyond;
    if (points.x[i].z() <= 0) ++result.beyond;
  }
  Vec3 loads = Vec3::Zero();
  for (const WallLoad& load : water->wall_loads()) loads += load.impulse;
  const Vec3 gap = water->momentum() + loads - water->impulse_from_gravity() - water->momentum_added();
  result.momentum_gap = gap.norm() / water->impulse_from_gravity().norm();
  return result;
}

TEST(ThinSheet, BetweenTwoLevelsHoldsTheWaterAndFeelsTheDifference) {
  const SheetResult result = two_levels(2.0);
  RecordProperty("force_ratio", std::to_string(result.force_ratio));
  EXPECT_EQ(result.beyond, 0U);
  EXPECT_NEAR(result.force_ratio, 1.0, 0.05);
  EXPECT_LT(result.momentum_gap, 1e-5);  // what gravity gave is in the water or in the walls
}

// A block of water slides over a lip at 2 m/s; beyond it nothing acts on it, though the plane goes on. A
// phantom wall of 1.4 h would hold it for 14 ms: 0.14 m/s of fall.
TEST(Jet, OverALipDoesNotFeelTheSheetBeyondIt) {
  const double h = 0.02, thickness = 3 * h, speed = 2.0;
  Domain domain = open_box(Vec3(-0.4, 0, -1.0), Vec3(1.4, thickness, 0.3));
  make_periodic(domain, 1);
  std::vector<Wall> parts;
  parts.push_back(sheet("ledge", 2, 0.0, Vec3(-0.5, -0.1, 0), Vec3(0, thickness + 0.1, 0)));
  const Walls walls(std::move(parts));
  MpmConfig config;
  config.spacing = h;
  config.fastest_bulk_speed = 4;
  config.wall_slip = WallSlip::slip;
  auto water = make_mpm(config, domain, gravity, walls);
  WaterFill fill;
  fill.box = {Vec3(-0.2, 0, 0), Vec3(-0.04, thickness, 0.04)};
  fill.velocity = [&](const Vec3&) { return Vec3(speed, 0, 0); };
  fill_with_water(*water, h / 2, fill);
  const double dt = water->limits().step;
  const int steps = static_cast<int>(0.36 / dt);
  int left = 0;
  Vec3 load_when_left = Vec3::Zero();
  for (int n = 0; n < steps; ++n) {
    step_water(*water, n * dt, dt);
    if (n % 20 != 0 || left != 0) continue;
    double nearest = 1e9;
    for (const Vec3& x : water->points().x) nearest = std::min(nearest, x.x());
    if (nearest > 1.6 * h) {
      left = n;
      load_when_left = water->wall_loads()[0].impulse;
    }
  }
  ASSERT_GT(left, 0);
  EXPECT_EQ(water->wall_loads()[0].impulse, load_when_left);
  const WaterPoints points = water->points();
  double lag = 0, forward = 0;
  for (std::size_t i = 0; i < points.count(); ++i) {
    const double since_lip = points.x[i].x() / points.v[i].x();
    lag += (points.v[i].z() + g * since_lip) / static_cast<double>(points.count());
    forward += points.v[i].x() / static_cast<double>(points.count());
  }
  EXPECT_NEAR(forward, speed, 0.02);
  EXPECT_LT(lag, 0.05);
  // The pressure of its own weight, which the sheet bears before the lip, pushes it down beyond that: by no
  // more than g depth / speed.
  EXPECT_GT(lag, -g * 0.04 / speed);
}

// Rocks that take 20 % of the lowest half of the water lift its level by their volume over the area. Each
// node gets the weight of the water they displace, which is what their buoyancy leaves on it.
TEST(VoidFraction, LiftsTheLevelByTheRocksVolumeOverTheArea) {
  const double h = 0.02, depth = 0.2, solids = 0.2, layer = 0.1;
  Domain domain = open_box(Vec3(0, 0, -0.1), Vec3(4 * h, 4 * h, 0.4));
  make_periodic(domain, 0);
  make_periodic(domain, 1);
  std::vector<Wall> parts;
  parts.push_back(sheet("floor", 2, 0.0, Vec3(-0.2, -0.2, 0), Vec3(0.4, 0.4, 0)));
  const Walls walls(std::move(parts));
  MpmConfig config;
  config.spacing = h;
  config.deepest = depth;
  config.fastest_bulk_speed = std::sqrt(g * depth);
  config.wall_slip = WallSlip::slip;
  auto water = make_mpm(config, domain, gravity, walls);
  WaterFill fill;
  fill.jitter = 0.1;
  fill.box = {Vec3(0, 0, 0), Vec3(4 * h, 4 * h, depth)};
  const double c = water->limits().sound_speed;
  fill.J = [&](const Vec3& x) { return still_J(depth - x.z(), c); };
  fill_with_water(*water, h / 2, fill);
  const double dt = water->limits().step;
  FluidNodes nodes;
  const auto level = [&] {  // height below which 97 % of the points lie
    std::vector<double> heights;
    for (const Vec3& x : water->points().x) heights.push_back(x.z());
    std::sort(heights.begin(), heights.end());
    return heights[heights.size() * 97 / 100];
  };
  const double before = level();
  for (int n = 0; n * dt < 1.0; ++n) {
    const double now = std::min(1.0, n * dt / 0.3) * solids;
    water->points_to_grid(n * dt, dt);
    water->read_nodes(nodes);
    std::vector<double> void_fraction(nodes.count(), 1.0);
    std::vector<Vec3> weight(nodes.count(), Vec3::Zero());
    for (std::size_t i = 0; i < nodes.count(); ++i) {
      if (nodes.x[i].z() > layer) continue;
      void_fraction[i] = 1 - now;
      weight[i] = nodes.mass[i] * now / (1 - now) * dt * gravity;
    }
    water->set_void_fraction(void_fraction);
    water->add_impulse(weight);
    water->walls(dt);
    water->grid_to_points(dt);
  }
  EXPECT_NEAR((level() - before) / (solids * layer), 1.0, 0.2);
}

TEST(Belt, CarriesTheWaterOnItAsAFilmOrNotAtAll) {
  const double h = 0.02, thickness = 4 * h, belt_speed = 2;
  Domain domain = open_box(Vec3(0, 0, -0.1), Vec3(8 * h, thickness, 0.2));
  make_periodic(domain, 0);
  make_periodic(domain, 1);
  for (const WallSlip slip : {WallSlip::slip, WallSlip::turbulent_film}) {
    std::vector<Wall> parts;
    parts.push_back(sheet("belt", 2, 0.0, Vec3(-0.2, -0.2, 0), Vec3(0.4, 0.4, 0)));
    parts[0].surface_velocity = Vec3(belt_speed, 0, 0);
    const Walls walls(std::move(parts));
    MpmConfig config;
    config.spacing = h;
    config.fastest_bulk_speed = belt_speed;
    config.wall_slip = slip;
    config.film_friction = 0.03;
    auto water = make_mpm(config, domain, gravity, walls);
    const double depth = 0.04;
    WaterFill fill;
    fill.box = {Vec3(0, 0, 0), Vec3(8 * h, thickness, depth)};
    const double c = water->limits().sound_speed;
    fill.J = [&](const Vec3& x) { return still_J(depth - x.z(), c); };
    fill_with_water(*water, h / 2, fill);
    const double dt = water->limits().step;
    const int steps = static_cast<int>(1.0 / dt);
    for (int n = 0; n < steps; ++n) step_water(*water, n * dt, dt);
    const double speed = water->momentum().x() / water->total_mass();
    const WallLoad& load = water->wall_loads()[0];
    // float sums: 1e-6 of what was handed over per 1000 steps, the weight of a second and the belt's momentum
    EXPECT_NEAR(load.impulse.x(), -water->momentum().x(),
                1e-9 * steps * water->total_mass() * (g + belt_speed));
    if (slip == WallSlip::slip) {
      EXPECT_NEAR(speed, 0.0, 1e-3);
    } else {
      // m du/dt = rho f/8 (U - u)2 over a well-mixed film: U - u = U / (1 + f U t / (8 depth)).
      const double exact = belt_speed - belt_speed / (1 + 0.03 * belt_speed * 1.0 / (8 * depth));
      // The layer at the belt runs ahead of the mean and is dragged less.
      EXPECT_NEAR(speed / exact, 0.8, 0.2);
      EXPECT_GT(load.sliding_energy, 0.0);
    }
  }
}

TEST(Water, OffThePlateOfRocksOnlyFallsThrough) {
  const double h = 0.02;
  Domain domain = open_box(Vec3(-0.2, -0.2, -0.5), Vec3(0.2, 0.2, 0.2));
  std::vector<Wall> parts;
  parts.push_back(sheet("deck", 2, 0.0, Vec3(-0.2, -0.2, 0), Vec3(0.2, 0.2, 0)));
  parts[0].blocks = BlocksPhase::rocks_only;
  const Walls walls(std::move(parts));
  MpmConfig config;
  config.spacing = h;
  config.fastest_bulk_speed = 3;
  auto water = make_mpm(config, domain, gravity, walls);
  WaterFill fill;
  fill.box = {Vec3(0, 0, 0.02), Vec3(0.08, 0.08, 0.1)};
  fill_with_water(*water, h / 2, fill);
  const double dt = water->limits().step;
  for (int n = 0; n * dt < 0.2; ++n) step_water(*water, n * dt, dt);
  EXPECT_EQ(water->wall_loads()[0].impulse, Vec3(0, 0, 0));
  for (const Vec3& x : water->points().x) EXPECT_LT(x.z(), 0.0);
}

}  // namespace
}  // namespace sluice
