#include "inflow/conveyor_feed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/memory_archive.h"
#include "inflow/belt_scene.h"
#include "inflow/fake_fluid.h"
#include "inflow/map_schema.h"

namespace sluice {
namespace {

using test::BeltScene;
using test::FakeFluid;

constexpr double speed = 2.0;  // of the belt [m/s]

ConveyorFeedConfig feed_config(double rate) {
  ConveyorFeedConfig c;
  c.name = "feed";
  c.rate = rate;
  c.belt_speed = speed;
  c.travel = Vec3(1, 0, 0);
  c.burden_width = 1.0;
  c.bed_depth = 0.2;
  c.material = "ore";
  c.sizes.points = {{0.005, 0}, {0.03, 0.2}, {0.08, 1}};
  c.sizes.cutoff = 0.03;
  c.below_cutoff = BelowCutoff::leave_out;
  return c;
}

struct FedBelt {
  BeltScene scene{0.03, 0.08, speed};
  std::vector<RockShape> table;
  ShapeMix mix = make_shape_mix({}, table);
  std::unique_ptr<Inflow> feed;

  explicit FedBelt(const ConveyorFeedConfig& c, FluidSystem* water = nullptr) {
    InflowTarget target = scene.target();
    target.water = water;
    feed = make_conveyor_feed(c, mix, target);
  }
  /// Feeds for a time and moves the rocks.
  void go(double from, double to) {
    const double dt = scene.rocks->step_size();
    for (double t = from; t < to; t += 10 * dt) {
      feed->advance(t, 10 * dt);
      for (int i = 0; i < 10; ++i) scene.rocks->step(t + i * dt, dt);
      scene.rocks->remove_outside();
    }
  }
};

TEST(ConveyorFeed, EntersWhatWasAskedLessOneRock) {
  FedBelt run(feed_config(30));
  run.go(0, 0.4);
  const InflowBudget b = run.feed->rock();
  const double largest = run.scene.rocks->mass_of(0, 1, 0.08);
  EXPECT_NEAR(b.requested, 0.8 * 30 * 0.4, 0.8 * 30 * 10 * run.scene.rocks->step_size());
  EXPECT_EQ(b.requested - b.entered, b.waiting);
  EXPECT_GE(b.waiting, 0);
  EXPECT_LT(b.waiting, largest);
  EXPECT_EQ(run.feed->warning(), "");
  double inside = 0;
  for (double m : run.scene.rocks->rocks().mass) inside += m;
  EXPECT_NEAR(b.entered, inside, 1e-12 * inside);
  EXPECT_LT((b.momentum - Vec3(speed * b.entered, 0, 0)).norm(), 1e-9);
}

TEST(ConveyorFeed, SetsRocksDownInsideTheBandAtBeltSpeed) {
  ConveyorFeedConfig c = feed_config(30);
  c.offset = 0.05;
  c.position = Vec3(0.5, 0, 0);
  FedBelt run(c);
  run.feed->advance(0, 0.2);
  const Rocks& rocks = run.scene.rocks->rocks();
  ASSERT_GT(rocks.count(), 10u);
  for (std::size_t i = 0; i < rocks.count(); ++i) {
    const double R = rocks.radius[i];
    EXPECT_LE(rocks.x[i].x() + R, 0.5 + 1e-12);
    EXPECT_GE(rocks.x[i].x() - R, 0.5 - 0.2 - 1e-12);
    EXPECT_LE(std::abs(rocks.x[i].y() - 0.05) + R, 0.5 + 1e-12);
    EXPECT_GE(rocks.x[i].z(), R);
    EXPECT_LE(rocks.x[i].z() + R, 0.2 + 1e-3);
    EXPECT_EQ(rocks.v[i], Vec3(speed, 0, 0));
    EXPECT_EQ(rocks.source[i], 3);
    EXPECT_EQ(rocks.material[i], 1);
  }
}

TEST(ConveyorFeed, WaitsAndSaysSoWhereThereIsNoRoom) {
  FedBelt run(feed_config(300));
  // The rocks are never moved: the band fills up.
  for (int i = 0; i < 60; ++i) run.feed->advance(0.01 * i, 0.01);
  const InflowBudget b = run.feed->rock();
  EXPECT_GT(b.waiting, 10);
  EXPECT_EQ(b.requested - b.entered, b.waiting);
  EXPECT_NE(run.feed->warning().find("wait for room"), std::string::npos);
}

TEST(ConveyorFeed, KeepsTheSizeDistributionWhenRoomIsShort) {
  // The same rocks enter, in number and size, whether or not they had to wait.
  FedBelt easy(feed_config(20)), tight(feed_config(110));
  easy.go(0, 1.1);
  tight.go(0, 0.2);
  const double a = easy.feed->rock().entered + easy.feed->rock().waiting;
  EXPECT_NEAR(a, tight.feed->rock().requested, 0.2);
  std::vector<double> first = easy.scene.rocks->rocks().size, second = tight.scene.rocks->rocks().size;
  std::sort(first.begin(), first.end());
  std::sort(second.begin(), second.end());
  const std::size_t n = std::min(first.size(), second.size());
  EXPECT_GT(n, 30u);
  EXPECT_NEAR(static_cast<double>(first.size()), static_cast<double>(second.size()), 6);
}

TEST(ConveyorFeed, CarriesAnIndustrialRateWithoutWaiting) {
  // 600 t/h on a bed of 0.2 m x 1 m at 2 m/s: 15 % of the stated section, loosely placed.
  FedBelt run(feed_config(600 / 3.6));
  run.go(0, 0.5);
  EXPECT_EQ(run.feed->warning(), "");
  EXPECT_LT(run.feed->rock().waiting, 0.05 * run.feed->rock().requested);
}

TEST(ConveyorFeed, HeapKeepsLowAtItsEdges) {
  ConveyorFeedConfig c = feed_config(60);
  c.profile = BedProfile::heaped;
  FedBelt run(c);
  run.feed->advance(0, 0.3);
  const Rocks& rocks = run.scene.rocks->rocks();
  for (std::size_t i = 0; i < rocks.count(); ++i) {
    const double y = 2 * rocks.x[i].y();
    const double top = std::max(0.2 * (1 - y * y), 2.03 * rocks.radius[i]);
    EXPECT_LE(rocks.x[i].z() + rocks.radius[i], top + 0.02 * rocks.radius[i]);
  }
}

TEST(ConveyorFeed, RunsBetweenStartAndStop) {
  ConveyorFeedConfig c = feed_config(30);
  c.start = 0.1;
  c.stop = 0.2;
  FedBelt run(c);
  run.feed->advance(0, 0.05);
  EXPECT_EQ(run.feed->rock().requested, 0);
  run.feed->advance(0.05, 0.5);
  EXPECT_NEAR(run.feed->rock().requested, 0.8 * 30 * 0.1, 1e-12);
}

TEST(ConveyorFeed, ContinuesBitForBitAfterARestart) {
  FedBelt whole(feed_config(60)), first(feed_config(60)), second(feed_config(60));
  for (int i = 0; i < 20; ++i) whole.feed->advance(0.005 * i, 0.005);
  for (int i = 0; i < 10; ++i) first.feed->advance(0.005 * i, 0.005);
  MemoryArchive archive;
  archive.enter("feed");
  first.feed->exchange(archive);
  archive.leave();
  archive.enter("rocks");
  first.scene.rocks->exchange(archive);
  archive.leave();
  archive.rewind_to_load();
  archive.enter("feed");
  second.feed->exchange(archive);
  archive.leave();
  archive.enter("rocks");
  second.scene.rocks->exchange(archive);
  archive.leave();
  for (int i = 10; i < 20; ++i) second.feed->advance(0.005 * i, 0.005);
  const Rocks &a = whole.scene.rocks->rocks(), &b = second.scene.rocks->rocks();
  ASSERT_EQ(a.count(), b.count());
  for (std::size_t i = 0; i < a.count(); ++i) {
    EXPECT_EQ(a.x[i], b.x[i]);
    EXPECT_EQ(a.size[i], b.size[i]);
    EXPECT_EQ(a.q[i].coeffs(), b.q[i].coeffs());
  }
  EXPECT_EQ(whole.feed->rock().entered, second.feed->rock().entered);
}

ConveyorFeedConfig wet_config() {
  ConveyorFeedConfig c = feed_config(100);
  c.below_cutoff = BelowCutoff::slurry;
  c.moisture = 0.15;
  return c;
}

TEST(BeltSlurry, CarriesMoistureAndFinesExactly) {
  FakeFluid fluid(0.01);
  FedBelt run(wet_config(), &fluid);
  for (int i = 0; i < 500; ++i) run.feed->advance(1e-3 * i, 1e-3);
  // 20 % of the feed is finer than the cut-off.
  EXPECT_NEAR(run.feed->fines().requested, 0.2 * 100 * 0.5, 1e-9);
  EXPECT_NEAR(run.feed->water().requested, (0.2 + 0.15) * 100 * 0.5, 1e-9);
  EXPECT_EQ(run.feed->water().entered, fluid.total_mass());
  EXPECT_NEAR(run.feed->fines().entered, fluid.total_fines(), 1e-9);
  EXPECT_NEAR(run.feed->fines().entered, 0.2 / 0.35 * run.feed->water().entered, 1e-6);
  EXPECT_LT(run.feed->water().waiting, 2.7e-3);
  EXPECT_GE(run.feed->water().waiting, 0);
  EXPECT_NEAR(run.feed->rock().requested, 0.8 * 100 * 0.5, 1e-9);
}

TEST(BeltSlurry, RidesTheBeltAtItsSpeed) {
  FakeFluid fluid(0.01);
  FedBelt run(wet_config(), &fluid);
  for (int i = 0; i < 100; ++i) run.feed->advance(1e-3 * i, 1e-3);
  ASSERT_GT(fluid.count(), 100u);
  for (std::size_t i = 0; i < fluid.count(); ++i) {
    EXPECT_EQ(fluid.points().v[i], Vec3(speed, 0, 0));
    EXPECT_GT(fluid.points().x[i].z(), 0);
    EXPECT_LE(std::abs(fluid.points().x[i].y()), 0.501);
  }
}

void expect_refused(const ConveyorFeedConfig& c, const std::string& key, FluidSystem* water = nullptr) {
  try {
    FedBelt run(c, water);
    FAIL() << "accepted, but '" << key << "' is wrong";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().key, key);
    EXPECT_FALSE(error.problems().front().suggestion.empty());
  }
}

TEST(ConveyorFeed, RefusesARateThatDoesNotFitTheBed) {
  const ConveyorFeedConfig c = feed_config(1000);
  EXPECT_DOUBLE_EQ(feed_capacity(c, 2700), 0.2 * 1.0 * speed * 0.6 * 2700);
  expect_refused(c, "rate");
}

TEST(ConveyorFeed, HeapCarriesTwoThirdsOfAFlatBed) {
  ConveyorFeedConfig c = feed_config(100);
  const double flat = feed_capacity(c, 2700);
  c.profile = BedProfile::heaped;
  EXPECT_DOUBLE_EQ(feed_capacity(c, 2700), flat * 2 / 3);
}

TEST(ConveyorFeed, RefusesAnUnknownMaterial) {
  ConveyorFeedConfig c = feed_config(30);
  c.material = "gold";
  expect_refused(c, "material");
}

TEST(ConveyorFeed, RefusesABandOutsideTheDomain) {
  ConveyorFeedConfig c = feed_config(30);
  c.position = Vec3(-1.9, 0, 0);
  expect_refused(c, "position");
}

TEST(ConveyorFeed, RefusesRocksWiderThanTheBurden) {
  ConveyorFeedConfig c = feed_config(1);
  c.burden_width = 0.07;
  expect_refused(c, "burden_width");
}

TEST(ConveyorFeed, RefusesFinesAndMoistureInADryScene) {
  expect_refused(wet_config(), "below_cutoff");
  ConveyorFeedConfig c = feed_config(30);
  c.moisture = 0.05;
  expect_refused(c, "moisture");
}

TEST(ConveyorFeed, RefusesASlurryTooThickToFlow) {
  FakeFluid fluid(0.01);
  ConveyorFeedConfig c = wet_config();
  c.moisture = 0.02;
  expect_refused(c, "moisture", &fluid);
}

TEST(ConveyorFeed, RefusesAnUprightBelt) {
  ConveyorFeedConfig c = feed_config(30);
  c.travel = Vec3(0, 0, 1);
  expect_refused(c, "travel");
}

TEST(ConveyorFeed, NeedsRocks) {
  std::vector<RockShape> table;
  EXPECT_THROW(make_conveyor_feed(feed_config(30), make_shape_mix({}, table), {}), InputError);
}

TEST(ConveyorFeedKeys, RefuseAStopBeforeTheStart) {
  test::MapSchema s;
  s.numbers_given = {{"start", 2}, {"stop", 1}};
  ConveyorFeedConfig c;
  c.keys(s);
  EXPECT_TRUE(s.complains_about("stop"));
  EXPECT_TRUE(s.complains_about("rate"));
  EXPECT_TRUE(s.complains_about("sizes"));
}

}  // namespace
}  // namespace sluice
