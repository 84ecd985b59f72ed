#include "analysis/exits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/budgets.h"
#include "base/memory_archive.h"
#include "inflow/belt_scene.h"
#include "inflow/fake_fluid.h"
#include "inflow/map_schema.h"

namespace sluice {
namespace {

using test::BeltScene;
using test::FakeFluid;

/// Upright rectangle x = 1, y -1 to 1, z 0 to 1.
ExitConfig plane() {
  ExitConfig c;
  c.name = "lip";
  c.low = Vec3(1, -1, 0);
  c.high = Vec3(1, 1, 1);
  c.bins = 4;
  return c;
}

void drop(FakeFluid& fluid, const Vec3& x, const Vec3& v) {
  fluid.add({.x = x, .v = v, .mass = 0.5, .fines_mass = 0.125});
}

TEST(Exits, PlaneTakesWhatCrossesItEitherWay) {
  FakeFluid fluid(0.1);
  drop(fluid, Vec3(0.9, 0.3, 0.5), Vec3(2, 0, 0));   // forwards
  drop(fluid, Vec3(1.1, 0.3, 0.5), Vec3(-2, 0, 0));  // backwards
  drop(fluid, Vec3(0.9, 0.3, 1.5), Vec3(2, 0, 0));   // above
  drop(fluid, Vec3(0.5, 0.3, 0.5), Vec3(2, 0, 0));   // too far
  drop(fluid, Vec3(0.9, 0.3, 0.95), Vec3(2, 0, 2));  // crosses above the edge
  Exits exits({plane()}, Walls{}, 0.1);
  fluid.drift(0.1);
  exits.collect(0.1, nullptr, &fluid);
  EXPECT_EQ(fluid.count(), 3u);
  EXPECT_DOUBLE_EQ(exits.tallies()[0].water_kg(), 1.0);
  EXPECT_DOUBLE_EQ(exits.tallies()[0].fines_kg(), 0.25);
  EXPECT_DOUBLE_EQ(exits.outside().water_kg(), 0);
}

TEST(Exits, BoxTakesWhatIsInside) {
  FakeFluid fluid(0.1);
  drop(fluid, Vec3(0.5, 0, 0.5), Vec3::Zero());
  drop(fluid, Vec3(1.5, 0, 0.5), Vec3::Zero());
  ExitConfig c = plane();
  c.kind = ExitKind::box;
  c.high.x() = 2;
  Exits exits({c}, Walls{}, 0.1);
  exits.collect(0.1, nullptr, &fluid);
  EXPECT_EQ(fluid.count(), 1u);
  EXPECT_DOUBLE_EQ(exits.tallies()[0].water_kg(), 0.5);
}

Walls with_deck() {
  Wall deck;
  deck.name = "deck";
  deck.mesh = make_rectangle("deck", {Vec3(0, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)});
  deck.blocks = BlocksPhase::rocks_only;
  std::vector<Wall> walls;
  walls.push_back(std::move(deck));
  return Walls(std::move(walls));
}

ExitConfig deck_exit() {
  ExitConfig c;
  c.name = "undersize";
  c.kind = ExitKind::deck;
  c.part = "deck";
  c.bins = 4;
  return c;
}

TEST(Exits, DeckTakesWaterThatCrossesThePart) {
  const Walls walls = with_deck();
  FakeFluid fluid(0.1);
  drop(fluid, Vec3(0.5, -0.9, 0.05), Vec3(0, 0, -1));
  drop(fluid, Vec3(1.5, 0.2, 0.05), Vec3(0, 0, -1));  // beside
  drop(fluid, Vec3(0.5, 0.2, 0.50), Vec3(0, 0, -1));  // not yet
  Exits exits({deck_exit()}, walls, 0.1);
  fluid.drift(0.1);
  exits.collect(0.1, nullptr, &fluid);
  EXPECT_EQ(fluid.count(), 2u);
  // The width is the deck's longest level edge, y -1 to 1.
  EXPECT_DOUBLE_EQ(exits.tallies()[0].at(1, 0).water_kg, 0.5);
}

TEST(Exits, FirstOfTwoGetsWhatBothWouldTake) {
  FakeFluid fluid(0.1);
  drop(fluid, Vec3(0.9, 0, 0.5), Vec3(2, 0, 0));
  ExitConfig second = plane();
  second.name = "second";
  second.low.x() = second.high.x() = 0.95;
  Exits exits({plane(), second}, Walls{}, 0.1);
  fluid.drift(0.1);
  exits.collect(0.1, nullptr, &fluid);
  EXPECT_DOUBLE_EQ(exits.tallies()[0].water_kg(), 0.5);
  EXPECT_DOUBLE_EQ(exits.tallies()[1].water_kg(), 0);
}

TEST(Exits, CountsWhatLeavesTheDomainAsOutside) {
  FakeFluid fluid(0.1);
  fluid.domain = {Vec3::Constant(-2), Vec3::Constant(2)};
  drop(fluid, Vec3(-1.9, 0, 0.5), Vec3(-2, 0, 0));
  Exits exits({plane()}, Walls{}, 0.1);
  fluid.drift(0.1);
  exits.collect(0.1, nullptr, &fluid);
  EXPECT_DOUBLE_EQ(exits.outside().water_kg(), 0.5);
  EXPECT_LT((momentum_left(exits) - Vec3(-1, 0, 0)).norm(), 1e-12);
}

TEST(Exits, SeesThePathThroughAPeriodicFace) {
  Domain domain;
  domain.box = {Vec3(0, -1, 0), Vec3(2, 1, 1)};
  domain.low[0] = domain.high[0] = Face::periodic;
  ExitConfig near_face = plane();
  near_face.low.x() = near_face.high.x() = 1.98;
  FakeFluid fluid(0.1);
  drop(fluid, Vec3(1.95, 0, 0.5), Vec3(-19, 0, 0));  // to x = 0.05: by the face, forwards
  drop(fluid, Vec3(0.05, 0, 0.5), Vec3(1, 0, 0));    // not near it
  fluid.drift(0.1);
  Exits exits({near_face}, Walls{}, 0.1, domain);
  exits.collect(0.1, nullptr, &fluid);
  EXPECT_DOUBLE_EQ(exits.tallies()[0].water_kg(), 0.5);
}

TEST(Exits, TakesRocksAndNotesWhatTheyWere) {
  BeltScene scene(0.05, 0.05, 0);
  ExitConfig c = plane();
  c.low.z() = -1;
  Exits exits({c}, scene.walls, 0.01);
  scene.rocks->add({.x = Vec3(0.999, 0.9, 0.5), .v = Vec3(2, 0, 0), .material = 1, .size = 0.05});
  scene.rocks->add({.x = Vec3(0.2, 0.2, 0.5), .v = Vec3(2, 0, 0), .material = 1, .size = 0.05});
  const double mass = scene.rocks->rocks().mass[0];
  exits.collect(0, scene.rocks.get(), nullptr);
  ASSERT_EQ(scene.rocks->rocks().count(), 2u);
  const double dt = scene.rocks->step_size();
  double t = 0;
  for (; t < 0.02; t += dt) {
    scene.rocks->step(t, dt);
    exits.collect(t + dt, scene.rocks.get(), nullptr);
  }
  EXPECT_EQ(scene.rocks->rocks().count(), 1u);
  const ExitTally& tally = exits.tallies()[0];
  EXPECT_EQ(tally.rock_kg(), mass);
  ASSERT_EQ(tally.sizes().size(), 1u);
  EXPECT_EQ(tally.sizes()[0], 0.05);
  EXPECT_EQ(tally.rocks().bin[0], 3);
  EXPECT_NEAR(tally.rocks().t[0], 0.0005, dt);
  EXPECT_NEAR(tally.rock_momentum().x(), 2 * mass, 1e-9);
  // It met no water: it left dry.
  EXPECT_EQ(tally.at(0, 3).dry_rock_kg, mass);
  const MassBudgets budgets = mass_budgets(exits, scene.rocks.get(), nullptr);
  EXPECT_EQ(budgets.rock.inside, mass);
  EXPECT_EQ(budgets.rock.left_sum(), mass);
}

TEST(Exits, DoesNotTakeARockThatWasPutBeyondThePlane) {
  BeltScene scene(0.05, 0.05, 0);
  Exits exits({plane()}, scene.walls, 0.01);
  scene.rocks->add({.x = Vec3(0.5, 0, 0.5), .material = 1, .size = 0.05});
  exits.collect(0, scene.rocks.get(), nullptr);
  scene.rocks->add({.x = Vec3(1.5, 0, 0.5), .material = 1, .size = 0.05});
  exits.collect(0.1, scene.rocks.get(), nullptr);
  EXPECT_EQ(scene.rocks->rocks().count(), 2u);
}

TEST(Exits, ContinueAfterARestart) {
  FakeFluid fluid(0.1);
  drop(fluid, Vec3(0.9, 0.3, 0.5), Vec3(2, 0, 0));
  Exits exits({plane()}, Walls{}, 0.1), again({plane()}, Walls{}, 0.1);
  fluid.drift(0.1);
  exits.collect(0.1, nullptr, &fluid);
  MemoryArchive archive;
  exits.exchange(archive);
  archive.rewind_to_load();
  again.exchange(archive);
  EXPECT_EQ(again.tallies()[0].water_kg(), 0.5);
  EXPECT_EQ(again.tallies()[0].slots(), exits.tallies()[0].slots());
  EXPECT_EQ(again.tallies()[0].at(1, 2).fines_kg, 0.125);
  EXPECT_EQ(again.tallies()[0].water_momentum(), Vec3(1, 0, 0));
}

TEST(ExitTally, KeepsEveryRockOverARestart) {
  ExitTally tally(plane(), 0.1), again(plane(), 0.1);
  tally.add({.t = 0.25,
             .x = Vec3(1, 0.6, 0),
             .v = Vec3(3, 0, 4),
             .mass = 2,
             .size = 0.1,
             .birth = 0.05,
             .wet_dose = 0.1,
             .rock = true});
  MemoryArchive archive;
  tally.exchange(archive);
  archive.rewind_to_load();
  again.exchange(archive);
  ASSERT_EQ(again.rocks().count(), 1u);
  EXPECT_DOUBLE_EQ(again.rocks().residence[0], 0.2);
  EXPECT_EQ(again.at(2, 3).rock_kg, 2);
  EXPECT_EQ(again.at(2, 3).rock_momentum, 10);
  EXPECT_EQ(again.at(2, 3).rock_energy, 25);
  EXPECT_EQ(again.at(2, 3).dry_rock_kg, 0);
}

TEST(ExitTally, PutsWhatIsBeyondTheWidthInTheEndBins) {
  const ExitTally tally(plane(), 0.1);
  EXPECT_EQ(tally.bin_of(Vec3(1, -5, 0)), 0u);
  EXPECT_EQ(tally.bin_of(Vec3(1, -0.51, 0)), 0u);
  EXPECT_EQ(tally.bin_of(Vec3(1, 0.01, 0)), 2u);
  EXPECT_EQ(tally.bin_of(Vec3(1, 5, 0)), 3u);
}

void expect_refused(const ExitConfig& c, const Walls& walls, const std::string& key) {
  Domain domain;
  domain.box = {Vec3::Constant(-2), Vec3::Constant(2)};
  try {
    check_exits({c}, domain, walls);
    FAIL() << "accepted, but '" << key << "' is wrong";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().key, key);
    EXPECT_FALSE(error.problems().front().suggestion.empty());
  }
}

TEST(CheckExits, RefusesAnExitOutsideTheDomain) {
  ExitConfig c = plane();
  c.low.x() = c.high.x() = 5;
  expect_refused(c, Walls{}, "low");
}

TEST(CheckExits, RefusesADeckThatIsMissingOrTight) {
  expect_refused(deck_exit(), Walls{}, "part");
  Wall tight;
  tight.name = "deck";
  tight.mesh = make_rectangle("deck", {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)});
  std::vector<Wall> walls;
  walls.push_back(std::move(tight));
  expect_refused(deck_exit(), Walls(std::move(walls)), "part");
  EXPECT_THROW(Exits({deck_exit()}, Walls{}, 0.1), InputError);
}

TEST(ExitKeys, RefuseAPlaneThatIsNotFlat) {
  test::MapSchema s;
  s.words["kind"] = "plane";
  s.vectors = {{"low", Vec3(0, 0, 0)}, {"high", Vec3(1, 1, 1)}};
  ExitConfig c;
  c.keys(s);
  EXPECT_TRUE(s.complains_about("high"));
}

TEST(ExitKeys, RefuseABoxWithoutVolumeAndHalfAWidth) {
  test::MapSchema s;
  s.words["kind"] = "box";
  s.vectors = {{"low", Vec3(0, 0, 0)}, {"high", Vec3(1, 1, 0)}, {"width_from", Vec3(0, 0, 0)}};
  ExitConfig c;
  c.keys(s);
  EXPECT_TRUE(s.complains_about("high"));
  EXPECT_TRUE(s.complains_about("width_to"));
}

TEST(ExitKeys, RefuseAPartForAPlane) {
  test::MapSchema s;
  s.words = {{"kind", "plane"}, {"part", "deck"}};
  s.vectors = {{"low", Vec3(0, 0, 0)}, {"high", Vec3(0, 1, 1)}};
  ExitConfig c;
  c.keys(s);
  EXPECT_TRUE(s.complains_about("part"));
}

}  // namespace
}  // namespace sluice
