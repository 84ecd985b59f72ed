#include "inflow/spray_nozzle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "inflow/emitters.h"
#include "inflow/map_schema.h"

namespace sluice {
namespace {

using std::numbers::pi;
using namespace test;

TEST(SprayNozzle, FlowGoesWithTheRootOfThePressure) {
  SprayNozzleConfig c = nozzle();
  c.pressure = 8e5;
  EXPECT_DOUBLE_EQ(c.flow_each(), 4e-3);
  c.pressure.reset();
  c.outlets.flow = 1e-3;
  EXPECT_DOUBLE_EQ(c.operating_pressure(), 0.5e5);
}

TEST(SprayNozzle, SpeedIsBernoullisTimesItsCoefficient) {
  // 2 bar: 20.0 m/s (spray_flux.csv).
  EXPECT_NEAR(nozzle().speed(1000), 0.95 * 20.0, 1e-12);
}

TEST(SprayNozzle, GivesItsFlowExactly) {
  FakeFluid fluid(spacing);
  SprayNozzleConfig c = nozzle();
  c.outlets.count = 7;
  c.outlets.spacing = Vec3(0.1, 0, 0);
  const auto spray = make_spray_nozzle(c, into(fluid));
  feed(*spray, 1000, 1e-3);
  EXPECT_NEAR(spray->water().requested, 7 * 2.0, 1e-9);
  EXPECT_EQ(spray->water().entered, fluid.total_mass());
  EXPECT_LT(spray->water().waiting, 1.000001e-3);
}

TEST(SprayNozzle, FanIsEvenOverItsAngle) {
  FakeFluid fluid(spacing / 4);
  SprayNozzleConfig c = nozzle();
  const auto spray = make_spray_nozzle(c, into(fluid));
  feed(*spray, 200, 1e-3);
  std::vector<double> bins(8);
  for (const Vec3& v : fluid.points().v) {
    const double along = std::atan2(v.x(), -v.z());
    const double across = std::asin(v.y() / v.norm());
    EXPECT_LE(std::abs(along), pi / 4 + 1e-12);
    EXPECT_LE(std::abs(across), 0.5 * c.thickness + 1e-12);
    bins[std::min<std::size_t>(7, static_cast<std::size_t>((along / (pi / 2) + 0.5) * 8))] += 1;
  }
  const double each = static_cast<double>(fluid.count()) / 8;
  for (double n : bins) EXPECT_NEAR(n, each, 0.01 * each);
}

TEST(SprayNozzle, FanGivesTheLineFluxOfTheReference) {
  // spray_flux.csv, 90 degrees at 0.3 m: line flux 2.12206591 /m in the middle, 1.69765273 /m at x = 0.15 m.
  FakeFluid fluid(spacing / 4);
  SprayNozzleConfig c = nozzle();
  c.thickness = 0;
  const auto spray = make_spray_nozzle(c, into(fluid));
  feed(*spray, 300, 1e-3);
  const auto flux = [&](double x) {
    double n = 0;
    for (const Vec3& v : fluid.points().v) n += std::abs(0.3 * v.x() / -v.z() - x) < 0.015 ? 1 : 0;
    return n / static_cast<double>(fluid.count()) / 0.03;
  };
  EXPECT_NEAR(flux(0), 2.12206591, 0.03);
  EXPECT_NEAR(flux(0.15), 1.69765273, 0.03);
}

TEST(SprayNozzle, ConeGivesTheFluxOfTheReference) {
  // spray_flux.csv, 60 degrees, uniform solid angle at 0.3 m: 13.1994296 /m2 in the middle, 8.57328105 at the
  // edge.
  FakeFluid fluid(spacing / 4);
  SprayNozzleConfig c = nozzle();
  c.pattern = SprayPattern::full_cone;
  c.angle = pi / 3;
  const auto spray = make_spray_nozzle(c, into(fluid));
  feed(*spray, 500, 1e-3);
  const auto flux = [&](double from, double to) {
    double n = 0;
    for (const Vec3& v : fluid.points().v) {
      const double r = 0.3 * std::hypot(v.x(), v.y()) / -v.z();
      n += r >= from && r < to ? 1 : 0;
    }
    return n / static_cast<double>(fluid.count()) / (pi * (to * to - from * from));
  };
  EXPECT_NEAR(flux(0, 0.03), 13.1994296, 0.02 * 13.2);
  EXPECT_NEAR(flux(0.165, 0.1732), 8.57328105, 0.03 * 8.57);
  EXPECT_EQ(flux(0.1733, 1), 0);
}

TEST(SprayNozzle, RollTurnsTheFan) {
  FakeFluid fluid(spacing);
  SprayNozzleConfig c = nozzle();
  c.roll = pi / 2;
  const auto spray = make_spray_nozzle(c, into(fluid));
  feed(*spray, 100, 1e-3);
  double x = 0, y = 0;
  for (const Vec3& v : fluid.points().v) {
    x = std::max(x, std::abs(v.x()));
    y = std::max(y, std::abs(v.y()));
  }
  EXPECT_GT(y, 10 * x);
}

TEST(SprayNozzle, LevelFanOfALevelNozzleLiesInThePlane) {
  FakeFluid fluid(spacing);
  SprayNozzleConfig c = nozzle();
  c.outlets.direction = Vec3(1, 0, 0);
  c.thickness = 0;
  const auto spray = make_spray_nozzle(c, into(fluid));
  feed(*spray, 100, 1e-3);
  for (const Vec3& v : fluid.points().v) EXPECT_NEAR(v.z(), 0, 1e-9);
}

TEST(SprayNozzleKeys, AskForOneOperatingPoint) {
  MapSchema none, both;
  both.numbers_given = {{"pressure", 2e5}, {"flow", 0.001}};
  SprayNozzleConfig a, b;
  a.keys(none);
  b.keys(both);
  EXPECT_TRUE(none.complains_about("pressure"));
  EXPECT_TRUE(both.complains_about("pressure"));
}

TEST(SprayNozzle, NeedsAScenesWater) {
  EXPECT_THROW(make_spray_nozzle(nozzle(), InflowTarget{}), InputError);
}

}  // namespace
}  // namespace sluice
