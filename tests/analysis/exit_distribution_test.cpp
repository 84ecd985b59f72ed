#include "analysis/exit_distribution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace sluice {
namespace {

ExitConfig lip(std::int64_t bins) {
  ExitConfig c;
  c.low = Vec3(1, 0, 0);
  c.high = Vec3(1, 2, 0.5);
  c.bins = bins;
  return c;
}

Passage rock(double t, double y, double mass, double size = 0.05) {
  return {.t = t, .x = Vec3(1, y, 0.1), .v = Vec3(3, 0, 0), .mass = mass, .size = size, .rock = true};
}
Passage water(double t, double y, double mass, double fines = 0) {
  return {.t = t, .x = Vec3(1, y, 0.1), .v = Vec3(0, 0, -2), .mass = mass, .fines_mass = fines};
}

TEST(ExitDistribution, GivesRatesSpeedsAndRatioPerBin) {
  ExitTally tally(lip(2), 0.1);
  for (int i = 0; i < 100; ++i) {
    const double t = 0.1 * i + 0.05;
    tally.add(rock(t, 0.5, 2));
    tally.add(rock(t, 1.5, 1));
    tally.add(water(t, 0.5, 3, 1));
  }
  const ExitDistribution d = exit_distribution(tally, {0, 10}, 1000);
  ASSERT_EQ(d.bins.size(), 2u);
  EXPECT_NEAR(d.bins[0].rock_kg_s.value, 20, 1e-9);
  EXPECT_NEAR(d.bins[0].rock_kg_s.half_width, 0, 1e-9);
  EXPECT_NEAR(d.bins[1].rock_kg_s.value, 10, 1e-9);
  EXPECT_NEAR(d.all.rock_kg_s.value, 30, 1e-9);
  EXPECT_NEAR(d.bins[0].water_kg_s.value, 30, 1e-9);
  EXPECT_NEAR(d.bins[0].fines_kg_s.value, 10, 1e-9);
  EXPECT_NEAR(d.bins[0].rock_speed.value, 3, 1e-12);
  EXPECT_NEAR(d.bins[0].water_speed.value, 2, 1e-12);
  // 200 kg of clear water over 200 kg of rock: one cubic metre a tonne.
  EXPECT_NEAR(d.bins[0].m3_per_tonne.value, 1, 1e-12);
  EXPECT_NEAR(d.bins[1].m3_per_tonne.value, 0, 1e-12);
  EXPECT_TRUE(std::isnan(d.bins[1].water_speed.value));
  EXPECT_NEAR(d.bins[1].from, 1, 1e-12);
  EXPECT_NEAR(d.bins[1].to, 2, 1e-12);
  EXPECT_NEAR(d.all.dry_share.value, 1, 1e-12);
  EXPECT_NEAR(d.all.energy_per_rock.value, 0.5 * 1.5 * 9, 1e-12);
}

TEST(ExitDistribution, CountsOnlyItsWindow) {
  ExitTally tally(lip(1), 0.1);
  tally.add(rock(0.05, 1, 100));
  tally.add(rock(0.55, 1, 7, 0.08));
  tally.add(rock(0.95, 1, 100));
  const ExitDistribution d = exit_distribution(tally, {0.5, 0.9}, 1000);
  EXPECT_NEAR(d.all.rock_kg_s.value * 0.4, 7, 1e-9);
  EXPECT_DOUBLE_EQ(d.all.p80.value, 0.08);
  EXPECT_NEAR(d.window.from, 0.5, 1e-12);
  EXPECT_NEAR(d.window.to, 0.9, 1e-12);
}

TEST(ExitDistribution, CountsTheTimeAfterTheLastPassage) {
  ExitTally tally(lip(1), 0.1);
  tally.add(rock(0.05, 1, 10));
  EXPECT_NEAR(exit_distribution(tally, {0, 1}, 1000).all.rock_kg_s.value, 10, 1e-9);
}

TEST(ExitDistribution, HasNoFiguresWhereNothingLeft) {
  const ExitTally tally(lip(3), 0.1);
  const ExitDistribution d = exit_distribution(tally, {0, 1}, 1000);
  EXPECT_EQ(d.all.rock_kg_s.value, 0);
  EXPECT_TRUE(std::isnan(d.all.p50.value));
  EXPECT_TRUE(std::isnan(d.rock.raw));
  EXPECT_TRUE(std::isnan(d.water_to_rock.raw));
}

TEST(Evenness, RemovesShotNoise) {
  // Rocks of two masses fall on 20 bins at random: an even feed. The raw figure is the Poisson floor.
  Random random(5);
  double raw2 = 0, corrected2 = 0, floor = 0;
  const int runs = 200;
  for (int run = 0; run < runs; ++run) {
    ExitTally tally(lip(20), 0.1);
    for (int i = 0; i < 2000; ++i) tally.add(rock(0.05, random.uniform(0, 2), i % 4 == 0 ? 5 : 1));
    const ExitDistribution d = exit_distribution(tally, {0, 0.1}, 1000);
    raw2 += d.rock.raw * d.rock.raw / runs;
    corrected2 += (d.rock.raw * d.rock.raw - d.rock.floor * d.rock.floor) / runs;
    floor = d.rock.floor;
  }
  // (sum m^2 / sum m) / (mass per bin) = (7 / 2) / 200.
  EXPECT_NEAR(floor * floor, 3.5 / 200, 1e-12);
  EXPECT_NEAR(raw2, 3.5 / 200, 0.05 * 3.5 / 200);
  EXPECT_NEAR(corrected2, 0, 0.05 * 3.5 / 200);
}

TEST(Evenness, OfTheRatioIsZeroWhereWaterFollowsRock) {
  ExitTally tally(lip(4), 0.1);
  for (int bin = 0; bin < 4; ++bin)
    for (int i = 0; i <= 50 * bin; ++i) {
      tally.add(rock(0.05, 0.25 + 0.5 * bin, 1));
      tally.add(water(0.05, 0.25 + 0.5 * bin, 2));
    }
  const ExitDistribution d = exit_distribution(tally, {0, 0.1}, 1000);
  EXPECT_NEAR(d.water_to_rock.raw, 0, 1e-12);
  EXPECT_GT(d.rock.raw, 0.5);
}

TEST(Evenness, OfTheRatioSeesOnlyItsOwnNoise) {
  Random random(6);
  double raw2 = 0, floor2 = 0;
  for (int run = 0; run < 200; ++run) {
    ExitTally tally(lip(10), 0.1);
    for (int i = 0; i < 3000; ++i) tally.add(rock(0.05, random.uniform(0, 2), 1));
    for (int i = 0; i < 6000; ++i) tally.add(water(0.05, random.uniform(0, 2), 0.25));
    const Evenness e = exit_distribution(tally, {0, 0.1}, 1000).water_to_rock;
    raw2 += e.raw * e.raw;
    floor2 += e.floor * e.floor;
  }
  EXPECT_NEAR(raw2, floor2, 0.07 * floor2);
}

/// A second of slots with rocks and water at random over two bins; the true figures follow from the chances.
ExitTally random_tally(Random& random) {
  ExitTally tally(lip(2), 0.1);
  for (int slot = 0; slot < 200; ++slot)
    for (int i = 0; i < 6; ++i) {
      const double t = 0.1 * slot + 0.05, y = random.uniform(0, 1) < 0.7 ? 0.5 : 1.5;
      Passage p = rock(t, y, random.uniform(0, 1) < 0.5 ? 1 : 3);
      p.wet_dose = random.uniform(0, 1) < 0.2 ? 0 : 1;
      tally.add(p);
      tally.add(water(t, random.uniform(0, 2), random.uniform(0, 2)));
    }
  return tally;
}

TEST(ExitDistribution, CoversTheTruthAboutAsOftenAsItSays) {
  Random random(17);
  const int runs = 600;
  int flow = 0, share = 0, ratio = 0, uneven = 0;
  const auto covers = [](double value, double half_width, double truth) {
    return std::abs(value - truth) <= half_width ? 1 : 0;
  };
  for (int run = 0; run < runs; ++run) {
    const ExitDistribution d = exit_distribution(random_tally(random), {0, 20}, 1000);
    flow += covers(d.all.rock_kg_s.value, d.all.rock_kg_s.half_width, 60 * 2);
    share += covers(d.all.dry_share.value, d.all.dry_share.half_width, 0.2);
    ratio += covers(d.all.m3_per_tonne.value, d.all.m3_per_tonne.half_width, 0.5);
    // Two bins with 0.7 and 0.3 of the mass: standard deviation 0.4 / sqrt(2) over mean 0.5.
    uneven += covers(d.rock.corrected, d.rock.corrected_half_width, 0.4 * std::sqrt(2.0));
  }
  // 95 % +- 3 standard errors of 0.9 %, and 1 % more below for what the jackknife leaves.
  for (const int covered : {flow, share, ratio, uneven}) {
    EXPECT_GT(covered, 0.913 * runs);
    EXPECT_LT(covered, 0.977 * runs);
  }
}

TEST(ExitDistribution, HasNoLimitsWhereAFigureHangsOnOneBatch) {
  ExitTally tally(lip(1), 0.1);
  for (int slot = 0; slot < 20; ++slot) tally.add(water(0.1 * slot + 0.05, 1, 1));
  tally.add(rock(0.55, 1, 7));
  const ExitDistribution d = exit_distribution(tally, {0, 2}, 1000);
  EXPECT_DOUBLE_EQ(d.all.rock_speed.value, 3);
  EXPECT_TRUE(std::isnan(d.all.rock_speed.half_width));
  EXPECT_TRUE(std::isfinite(d.all.rock_kg_s.half_width));
}

TEST(ReachedFraction, IsTheExitRateOverTheFeed) {
  std::vector<ExitTally> tallies{ExitTally(lip(2), 0.1), ExitTally(lip(1), 0.1)};
  for (int i = 0; i < 20; ++i) {
    tallies[0].add(rock(0.1 * i + 0.05, 0.5, 3));
    tallies[1].add(rock(0.1 * i + 0.05, 0.5, 1));
  }
  EXPECT_NEAR(reached_fraction(tallies, 50, {1, 2}), 0.8, 1e-9);
  EXPECT_EQ(reached_fraction(tallies, 50, {1, 1}), 0);
}

TEST(RockSeries, HasEverySlotOfTheRun) {
  ExitTally tally(lip(2), 0.1);
  tally.add(rock(0.25, 0.5, 3));
  tally.add(water(0.35, 0.5, 4));
  EXPECT_EQ(rock_series(tally, 0.5), (std::vector<double>{0, 0, 3, 0, 0}));
  EXPECT_EQ(water_series(tally, 0.5), (std::vector<double>{0, 0, 0, 4, 0}));
}

}  // namespace
}  // namespace sluice
