#include "inflow/channel_inflow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/memory_archive.h"
#include "inflow/emitters.h"

namespace sluice {
namespace {

using namespace test;

constexpr double g = 9.81;

ChannelInflowConfig channel(double flow) {
  ChannelInflowConfig c;
  c.name = "launder";
  c.width = 0.3;
  c.depth = 0.2;
  c.outlets.position = Vec3(1, 2, 3);
  c.outlets.direction = Vec3(2, 0, 0);
  c.outlets.flow = flow;
  return c;
}

TEST(ChannelInflow, GivesItsFlowExactly) {
  FakeFluid fluid(spacing);
  const auto inflow = make_channel_inflow(channel(0.0317), into(fluid));
  feed(*inflow, 777, 1.3e-3);
  const InflowBudget b = inflow->water();
  EXPECT_NEAR(b.requested, 1000 * 0.0317 * 777 * 1.3e-3, 1e-9);
  EXPECT_EQ(b.entered, fluid.total_mass());
  EXPECT_NEAR(b.requested - b.entered - b.waiting, 0, 1e-12 * b.requested);
  EXPECT_GE(b.waiting, 0);
  EXPECT_LT(b.waiting, 1000 * fluid.point_volume() * 1.000001);
}

TEST(ChannelInflow, CarriesTheMomentumOfItsMeanSpeed) {
  for (const ChannelProfile profile : {ChannelProfile::flat, ChannelProfile::turbulent}) {
    FakeFluid fluid(spacing);
    ChannelInflowConfig c = channel(0.06);
    c.profile = profile;
    const auto inflow = make_channel_inflow(c, into(fluid));
    feed(*inflow, 400, 1e-3);
    EXPECT_NEAR(c.speed(), 0.06 / (0.3 * 0.2), 1e-12);
    // Points carry equal flux: their mean speed is that of momentum, 64/63 of the 1/7 power law's mean.
    const double of_flux = profile == ChannelProfile::flat ? 1 : 64.0 / 63;
    const Vec3 wanted = inflow->water().entered * of_flux * c.speed() * Vec3(1, 0, 0);
    EXPECT_LT((inflow->water().momentum - wanted).norm(), 2e-3 * wanted.norm());
    EXPECT_LT((inflow->water().momentum - fluid.momentum()).norm(), 1e-9 * wanted.norm());
  }
}

TEST(ChannelInflow, BringsThePushOfTheWaterBehindWhereItIsRapid) {
  FakeFluid fluid(spacing);
  const ChannelInflowConfig c = channel(0.24);  // 4 m/s, waves 1.4 m/s
  ASSERT_TRUE(is_rapid(c, g));
  ASSERT_FALSE(is_rapid(channel(0.06), g));
  const auto inflow = make_channel_inflow(c, into(fluid));
  feed(*inflow, 400, 1e-3);
  const double rate = 1000 * 0.24 * 4 + 0.5 * 1000 * g * 0.2 * 0.2 * 0.3;  // [N]
  const double wanted = rate * inflow->water().entered / (1000 * 0.24);
  EXPECT_NEAR(inflow->water().momentum.x(), wanted, 1e-3 * wanted);
  double fastest = 0;
  for (const Vec3& v : fluid.points().v) fastest = std::max(fastest, v.x());
  EXPECT_NEAR(fastest, fastest_speed(c, g), 0.01 * fastest);
}

TEST(ChannelInflow, FillsItsSectionEvenly) {
  FakeFluid fluid(spacing);
  const auto inflow = make_channel_inflow(channel(0.06), into(fluid));  // 1 m/s
  for (int i = 0; i < 700; ++i) {
    inflow->advance(i * 1e-3, 1e-3);
    fluid.drift(1e-3);
  }
  const WaterPoints p = fluid.points();
  std::vector<double> mass(4 * 6);
  for (std::size_t i = 0; i < p.count(); ++i) {
    const Vec3 x = p.x[i] - Vec3(1, 2, 3);
    EXPECT_LE(std::abs(x.y()), 0.5 * 0.3 + 0.1 * spacing);
    EXPECT_LE(std::abs(x.z()), 0.5 * 0.2 + 1e-9);
    if (x.x() < 0.1 || x.x() > 0.6) continue;
    const auto row = static_cast<std::size_t>((x.z() + 0.1) / 0.2 * 3.9999);
    const auto column = static_cast<std::size_t>(std::clamp((x.y() + 0.15) / 0.3, 0.0, 0.9999) * 6);
    mass[6 * row + column] += p.mass[i];
  }
  const double even = 1000 * 0.5 * 0.3 * 0.2 / 24;
  for (const double m : mass) EXPECT_NEAR(m, even, 0.03 * even);
}

TEST(ChannelInflow, ComesUnderThePressureOfTheWaterAboveIt) {
  FakeFluid fluid(spacing);
  InflowTarget target = into(fluid);
  target.gravity = {3, 0, -g};  // the bed slopes down along the channel
  const auto inflow = make_channel_inflow(channel(0.06), target);
  feed(*inflow, 100, 1e-3);
  const WaterPoints p = fluid.points();
  ASSERT_GT(p.count(), 1000u);
  for (std::size_t i = 0; i < p.count(); ++i) {
    const double below = 3 + 0.5 * 0.2 - p.x[i].z();
    EXPECT_NEAR(p.pressure[i], 1000 * g * below, 1e-6 * 1000 * g);
  }
}

TEST(ChannelInflow, RunsFasterAtTheSurfaceByTheSeventhRoot) {
  FakeFluid fluid(spacing);
  ChannelInflowConfig c = channel(0.06);
  c.profile = ChannelProfile::turbulent;
  const auto inflow = make_channel_inflow(c, into(fluid));
  inflow->advance(0, 0.2);
  const WaterPoints p = fluid.points();
  for (std::size_t i = 0; i < p.count(); ++i) {
    const double z = (p.x[i].z() - 3 + 0.1) / 0.2;
    EXPECT_NEAR(p.v[i].x(), 8.0 / 7 * std::pow(std::max(z, 0.02), 1.0 / 7), 0.03);
  }
  for (const double F : {0.0, 0.2, 0.7, 1.0}) {
    const double z = flux_height(ChannelProfile::turbulent, F);
    EXPECT_NEAR(std::pow(z, 8.0 / 7), F, 1e-14);
  }
}

TEST(ChannelInflow, IsTheSameAfterARestart) {
  FakeFluid whole(spacing), cut(spacing);
  const auto a = make_channel_inflow(channel(0.06), into(whole));
  const auto b = make_channel_inflow(channel(0.06), into(cut));
  feed(*a, 60, 1e-3);
  feed(*b, 25, 1e-3);
  const auto c = make_channel_inflow(channel(0.06), into(cut));
  MemoryArchive archive;
  b->exchange(archive);
  archive.rewind_to_load();
  c->exchange(archive);
  feed(*c, 35, 1e-3, 25e-3);
  ASSERT_EQ(whole.count(), cut.count());
  const WaterPoints p = whole.points(), q = cut.points();
  for (std::size_t i = 0; i < p.count(); ++i) {
    EXPECT_EQ(p.x[i], q.x[i]);
    EXPECT_EQ(p.J[i], q.J[i]);
  }
}

TEST(ChannelInflow, RefusesToRunStraightDownOrWithoutGravityOrWater) {
  FakeFluid fluid(spacing);
  ChannelInflowConfig c = channel(0.06);
  c.outlets.direction = Vec3(0.05, 0, -1);
  EXPECT_THROW(make_channel_inflow(c, into(fluid)), InputError);
  InflowTarget nowhere = into(fluid);
  nowhere.gravity = Vec3::Zero();
  EXPECT_THROW(make_channel_inflow(channel(0.06), nowhere), InputError);
  EXPECT_THROW(make_channel_inflow(channel(0.06), InflowTarget{}), InputError);
}

}  // namespace
}  // namespace sluice
