#include "analysis/gauges.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/memory_archive.h"
#include "inflow/belt_scene.h"
#include "inflow/fake_fluid.h"
#include "inflow/map_schema.h"

namespace sluice {
namespace {

GaugeConfig gauge(GaugeKind kind) {
  GaugeConfig c;
  c.name = "g";
  c.kind = kind;
  return c;
}

void fill(test::FakeFluid& fluid, double height) {
  for (double z = 0.01; z < height; z += 0.02)
    for (double x = 0.01; x < 0.2; x += 0.02)
      for (double y = 0.01; y < 0.2; y += 0.02)
        fluid.add({.x = Vec3(x, y, z), .mass = 0.008, .fines_mass = 0.002, .J = 0.99});
}

TEST(LevelGauge, ReadsTheSurfaceOfStandingWater) {
  test::FakeFluid fluid(0.02);
  fill(fluid, 0.3);
  fluid.add({.x = Vec3(0.1, 0.1, 2), .mass = 0.008});  // a droplet high above
  GaugeConfig c = gauge(GaugeKind::level);
  c.x = c.y = 0.1;
  c.radius = 0.05;
  const auto probe = make_gauge(c);
  EXPECT_TRUE(std::isnan(probe->values()[0]));
  probe->look({.t = 1, .water = &fluid});
  EXPECT_EQ(probe->columns(), std::vector<std::string>{"g_level_m"});
  EXPECT_NEAR(probe->values()[0], 0.3, 0.01);
}

TEST(LevelGauge, IsUnknownWhereItIsDry) {
  EXPECT_TRUE(std::isnan(column_level({})));
  EXPECT_TRUE(std::isnan(column_level({0.1, 0.2})));
}

TEST(PressureGauge, ReadsTheMeanInItsBox) {
  test::FakeFluid fluid(0.02);
  fill(fluid, 0.1);
  fluid.add({.x = Vec3(0.1, 0.1, 0.5), .mass = 0.008});
  GaugeConfig c = gauge(GaugeKind::pressure);
  c.low = Vec3::Zero();
  c.high = Vec3(0.2, 0.2, 0.2);
  const auto probe = make_gauge(c);
  probe->look({.t = 1, .water = &fluid});
  EXPECT_NEAR(probe->values()[0], pressure_of(1000, 20, 0.99), 1e-9);
}

TEST(HoldupGauge, CountsBothPhases) {
  test::FakeFluid fluid(0.02);
  fill(fluid, 0.1);
  test::BeltScene scene(0.05, 0.05, 0);
  scene.rocks->add({.x = Vec3(0.1, 0.1, 0.1), .material = 1, .size = 0.05});
  scene.rocks->add({.x = Vec3(1, 0.1, 0.1), .material = 1, .size = 0.05});
  const double mass = scene.rocks->rocks().mass[0];
  const auto all = make_gauge(gauge(GaugeKind::holdup));
  all->look({.t = 1, .rocks = scene.rocks.get(), .water = &fluid});
  EXPECT_DOUBLE_EQ(all->values()[0], 2 * mass);
  EXPECT_DOUBLE_EQ(all->values()[1], fluid.total_mass());
  EXPECT_DOUBLE_EQ(all->values()[2], fluid.total_fines());
  GaugeConfig c = gauge(GaugeKind::holdup);
  c.low = Vec3::Zero();
  c.high = Vec3(0.2, 0.2, 0.2);
  const auto part = make_gauge(c);
  part->look({.t = 1, .rocks = scene.rocks.get(), .water = &fluid});
  EXPECT_DOUBLE_EQ(part->values()[0], mass);
  EXPECT_NEAR(part->values()[1], fluid.total_mass(), 1e-12);
}

TEST(Gauges, KeepTheirReadingOverARestart) {
  test::FakeFluid fluid(0.02);
  fill(fluid, 0.1);
  const auto probe = make_gauge(gauge(GaugeKind::holdup)), again = make_gauge(gauge(GaugeKind::holdup));
  probe->look({.t = 1, .water = &fluid});
  MemoryArchive archive;
  probe->exchange(archive);
  archive.rewind_to_load();
  again->exchange(archive);
  EXPECT_EQ(again->values(), probe->values());
}

TEST(GaugeKeys, RefuseHalfABoxAndARadiusForAHoldup) {
  test::MapSchema s;
  s.words["kind"] = "holdup";
  s.numbers_given["radius"] = 0.1;
  s.vectors["low"] = Vec3::Zero();
  GaugeConfig c;
  c.keys(s);
  EXPECT_TRUE(s.complains_about("radius"));
  EXPECT_TRUE(s.complains_about("high"));
}

}  // namespace
}  // namespace sluice
