#include "inflow/initial_fill.h"

#include <gtest/gtest.h>

#include <cmath>

#include "inflow/belt_scene.h"
#include "inflow/fake_fluid.h"
#include "inflow/map_schema.h"

namespace sluice {
namespace {

using test::BeltScene;
using test::FakeFluid;

WaterFillConfig pool() {
  WaterFillConfig c;
  c.name = "pool";
  c.low = Vec3(0, 0, 0);
  c.high = Vec3(0.31, 0.2, 0.5);
  c.level = 0.4;
  return c;
}

InflowTarget into(FluidSystem& fluid) {
  InflowTarget target;
  target.water = &fluid;
  target.domain.box = {Vec3::Constant(-1), Vec3::Constant(1)};
  return target;
}

TEST(FillWater, FillsTheBoxExactly) {
  FakeFluid fluid(0.01);
  WaterFillConfig c = pool();
  c.hydrostatic = false;
  const FilledMass filled = fill_water(c, Walls{}, into(fluid));
  EXPECT_EQ(filled.count, 31u * 20 * 40);
  // Each mass is rounded to float, alike.
  EXPECT_NEAR(filled.mass, 1000 * 0.31 * 0.2 * 0.4, 1e-7 * 25);
  EXPECT_EQ(filled.mass, fluid.total_mass());
  EXPECT_EQ(filled.fines, 0);
  for (double J : fluid.points().J) EXPECT_EQ(J, 1);
}

TEST(FillWater, StartsUnderItsOwnWeight) {
  FakeFluid fluid(0.01);
  fill_water(pool(), Walls{}, into(fluid));
  const WaterPoints points = fluid.points();
  double bottom = 0, mass = 0;
  for (std::size_t i = 0; i < points.count(); ++i) {
    // p = rho g depth up to the compression itself: (g depth / c^2) / 2 = 0.5 %.
    const double depth = 0.4 - points.x[i].z();
    EXPECT_NEAR(points.pressure[i], 1000 * 9.81 * depth, 0.006 * 1000 * 9.81 * depth);
    bottom = std::max(bottom, points.pressure[i]);
    mass += points.mass[i];
  }
  // Exactly: the pressure at the floor carries the mass above it, p A = m g.
  const double floor = 1000 * 400 * std::expm1(9.81 * 0.4 / 400);
  EXPECT_NEAR(mass * 9.81 / (0.31 * 0.2), floor, 1e-4 * floor);
}

TEST(FillWater, StopsAtAClosedWall) {
  FakeFluid fluid(0.02);
  WaterFillConfig c = pool();
  c.low = Vec3::Constant(-0.5);
  c.high = Vec3::Constant(0.5);
  c.level.reset();
  c.inside = "tank";
  c.hydrostatic = false;
  Wall tank;
  tank.name = "tank";
  tank.mesh = make_box("tank", {Vec3::Constant(-0.2), Vec3::Constant(0.2)});
  std::vector<Wall> walls;
  walls.push_back(tank);
  const FilledMass filled = fill_water(c, Walls(std::move(walls)), into(fluid));
  EXPECT_NEAR(filled.mass, 64, 1e-4);
  for (const Vec3& x : fluid.points().x) EXPECT_LT(x.cwiseAbs().maxCoeff(), 0.2);
}

TEST(FillWater, CarriesFinesByVolume) {
  FakeFluid fluid(0.02);
  WaterFillConfig c = pool();
  c.hydrostatic = false;
  c.fines = 0.2;
  const FilledMass filled = fill_water(c, Walls{}, into(fluid));
  EXPECT_NEAR(filled.fines / filled.mass, 0.2 * 2700 / (0.2 * 2700 + 0.8 * 1000), 1e-6);
}

TEST(FillWater, JittersWithinItsShare) {
  FakeFluid even(0.02), shaken(0.02);
  WaterFillConfig c = pool();
  fill_water(c, Walls{}, into(even));
  c.jitter = 0.25;
  fill_water(c, Walls{}, into(shaken));
  double largest = 0;
  for (std::size_t i = 0; i < even.count(); ++i)
    largest = std::max(largest, (even.points().x[i] - shaken.points().x[i]).cwiseAbs().maxCoeff());
  EXPECT_GT(largest, 0.2 * 0.02);
  EXPECT_LT(largest, 0.26 * 0.021);
}

void expect_water_refused(const WaterFillConfig& c, const std::string& key) {
  FakeFluid fluid(0.02);
  try {
    fill_water(c, Walls{}, into(fluid));
    FAIL() << "accepted, but '" << key << "' is wrong";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().key, key);
  }
}

TEST(FillWater, RefusesWhatCannotBe) {
  WaterFillConfig outside = pool(), unknown = pool(), thick = pool();
  outside.high.x() = 2;
  expect_water_refused(outside, "high");
  unknown.inside = "bucket";
  expect_water_refused(unknown, "inside");
  thick.fines = 0.7;
  expect_water_refused(thick, "fines");
  EXPECT_THROW(fill_water(pool(), Walls{}, {}), InputError);
}

TEST(FillWaterKeys, RefuseALevelOutsideTheBox) {
  test::MapSchema s;
  s.vectors = {{"low", Vec3::Zero()}, {"high", Vec3::Ones()}};
  s.numbers_given = {{"level", 2}};
  WaterFillConfig c;
  c.keys(s);
  EXPECT_TRUE(s.complains_about("level"));
}

RockFillConfig pile() {
  RockFillConfig c;
  c.name = "pile";
  c.low = Vec3(-0.5, -0.5, 0);
  c.high = Vec3(0.5, 0.5, 1);
  c.count = 200;
  c.material = "ore";
  c.sizes.points = {{0.03, 0}, {0.08, 1}};
  return c;
}

struct RockBox {
  BeltScene scene{0.03, 0.08, 0};
  std::vector<RockShape> table;
  ShapeMix mix = make_shape_mix({}, table);
  FilledMass fill(const RockFillConfig& c) { return fill_rocks(c, mix, scene.target()); }
};

TEST(FillRocks, PlacesTheCountWithoutTouching) {
  RockBox box;
  const FilledMass filled = box.fill(pile());
  const Rocks& rocks = box.scene.rocks->rocks();
  ASSERT_EQ(rocks.count(), 200u);
  EXPECT_EQ(filled.count, 200u);
  double mass = 0;
  for (std::size_t i = 0; i < rocks.count(); ++i) {
    mass += rocks.mass[i];
    EXPECT_GE(rocks.x[i].z(), rocks.radius[i]);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT((rocks.x[i] - rocks.x[j]).norm(), rocks.radius[i] + rocks.radius[j]);
  }
  EXPECT_NEAR(filled.mass, mass, 1e-12 * mass);
}

TEST(FillRocks, MeetsAMassToHalfARock) {
  RockBox box;
  RockFillConfig c = pile();
  c.count = 0;
  c.mass = 50;
  const FilledMass filled = box.fill(c);
  EXPECT_NEAR(filled.mass, 50, 0.51 * box.scene.rocks->mass_of(0, 1, 0.08));
}

TEST(FillRocks, RefusesWhatDoesNotFit) {
  RockBox box;
  RockFillConfig c = pile();
  c.low = Vec3(-0.1, -0.1, 0);
  c.high = Vec3(0.1, 0.1, 0.2);
  const auto expect_refused = [&](std::int64_t count, const char* reason) {
    c.count = count;
    try {
      box.fill(c);
      FAIL() << count << " rocks in a small box";
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().front().key, "count");
      EXPECT_NE(error.problems().front().reason.find(reason), std::string::npos) << error.what();
    }
  };
  expect_refused(2'000'000'000, "fill the box");  // seen before any is placed
  c.high.x() = -0.06;                             // narrower than most rocks
  expect_refused(20, "found room");
}

TEST(FillRocks, RefusesAnUnknownMaterialAndABoxOutside) {
  RockBox box;
  RockFillConfig c = pile();
  c.material = "gold";
  EXPECT_THROW(box.fill(c), InputError);
  c = pile();
  c.high.z() = 30;
  EXPECT_THROW(box.fill(c), InputError);
  EXPECT_THROW(fill_rocks(pile(), box.mix, {}), InputError);
}

TEST(FillRocksKeys, AskForCountOrMass) {
  test::MapSchema none, both;
  both.numbers_given = {{"count", 3}, {"mass", 10}};
  RockFillConfig a, b;
  a.keys(none);
  b.keys(both);
  EXPECT_TRUE(none.complains_about("count"));
  EXPECT_TRUE(both.complains_about("mass"));
}

}  // namespace
}  // namespace sluice
