#include "inflow/size_distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "inflow/map_schema.h"

namespace sluice {
namespace {

/// Sieve curve and percentiles worked by hand: analysis_psd_worked.json (Rosin & Rammler 1933; ISO 9276).
SizeDistributionConfig worked_curve(SizeInterpolation interpolation) {
  const std::vector<double> mm{0.3, 0.6, 1.18, 2.36, 4.75, 6.7, 9.5, 13.2, 19, 26.5, 37.5, 53, 75, 100};
  const std::vector<double> percent{2.5, 4, 6, 9, 14, 18, 24, 31, 42, 55, 70, 85, 96, 100};
  SizeDistributionConfig c;
  for (std::size_t i = 0; i < mm.size(); ++i) c.points.push_back({1e-3 * mm[i], 1e-2 * percent[i]});
  c.interpolation = interpolation;
  c.cutoff = 9.5e-3;
  return c;
}

TEST(SizeDistribution, GivesTheWorkedPercentilesOverTheLogarithm) {
  const SizeDistribution d(worked_curve(SizeInterpolation::log_linear));
  EXPECT_NEAR(d.size_at(0.2), 7.527043112880533e-3, 1e-12);
  EXPECT_NEAR(d.size_at(0.5), 23.31695973749557e-3, 1e-12);
  EXPECT_NEAR(d.size_at(0.8), 47.22743246368424e-3, 1e-12);
}

TEST(SizeDistribution, GivesTheWorkedPercentilesOverTheSize) {
  const SizeDistribution d(worked_curve(SizeInterpolation::linear));
  EXPECT_NEAR(d.size_at(0.2), 7.633333333333334e-3, 1e-12);
  EXPECT_NEAR(d.size_at(0.5), 23.615384615384613e-3, 1e-12);
  EXPECT_NEAR(d.size_at(0.8), 47.833333333333336e-3, 1e-12);
}

TEST(SizeDistribution, PassingInvertsSizeAt) {
  const SizeDistribution d(worked_curve(SizeInterpolation::log_linear));
  for (double q = 0.05; q < 1; q += 0.05) EXPECT_NEAR(d.passing(d.size_at(q)), q, 1e-12);
}

TEST(SizeDistribution, CountsWhatIsBelowTheCutOffAsFines) {
  const SizeDistribution d(worked_curve(SizeInterpolation::log_linear));
  EXPECT_NEAR(d.fines_fraction(), 0.24, 1e-12);
  EXPECT_DOUBLE_EQ(d.smallest(), 9.5e-3);
  EXPECT_DOUBLE_EQ(d.largest(), 0.1);
}

TEST(SizeDistribution, FollowsRosinAndRammler) {
  // Worked inverse for x63 = 40 mm, k = 1.1: analysis_psd_worked.json.
  SizeDistributionConfig c;
  c.curve = SizeCurve::rosin_rammler;
  c.d63 = 0.04;
  c.spread = 1.1;
  c.cutoff = 1e-3;
  c.top_size = 1.0;  // passing there: 1 - 1e-15
  const SizeDistribution d(c);
  EXPECT_NEAR(d.size_at(0.2), 10.22972448940515e-3, 2e-5);
  EXPECT_NEAR(d.size_at(0.5), 28.665258662329688e-3, 2e-5);
  EXPECT_NEAR(d.size_at(0.8), 61.65178464094567e-3, 4e-5);
  EXPECT_NEAR(d.fines_fraction(), 1 - std::exp(-std::pow(1e-3 / 0.04, 1.1)), 1e-4);
}

/// Mass of drawn rocks below a size, over all.
double drawn_passing(const std::vector<double>& sizes, double size) {
  double below = 0, all = 0;
  for (double d : sizes) {
    all += d * d * d;
    if (d < size) below += d * d * d;
  }
  return below / all;
}

class Draws : public testing::TestWithParam<SizeInterpolation> {};

TEST_P(Draws, MatchTheCurveByMass) {
  const SizeDistribution d(worked_curve(GetParam()));
  Random random(1);
  std::vector<double> sizes;
  double cubes = 0;
  for (int i = 0; i < 400000; ++i) {
    sizes.push_back(d.draw(random));
    cubes += std::pow(sizes.back(), 3);
  }
  // Standard error of these shares, from the effective number of rocks (sum m)^2 / sum m^2, is below 0.005.
  for (double size : {0.0132, 0.019, 0.03, 0.053, 0.075}) {
    const double wanted = (d.passing(size) - d.fines_fraction()) / (1 - d.fines_fraction());
    EXPECT_NEAR(drawn_passing(sizes, size), wanted, 0.02) << size;
  }
  EXPECT_NEAR(cubes / 400000, d.mean_cube(), 0.03 * d.mean_cube());
  EXPECT_GE(*std::min_element(sizes.begin(), sizes.end()), d.smallest());
  EXPECT_LE(*std::max_element(sizes.begin(), sizes.end()), d.largest());
}

INSTANTIATE_TEST_SUITE_P(Interpolations, Draws,
                         testing::Values(SizeInterpolation::log_linear, SizeInterpolation::linear));

TEST(SizeDistribution, OfOneSizeDrawsThatSize) {
  SizeDistributionConfig c;
  c.curve = SizeCurve::single;
  c.size = 0.05;
  const SizeDistribution d(c);
  Random random(2);
  EXPECT_DOUBLE_EQ(d.draw(random), 0.05);
  EXPECT_DOUBLE_EQ(d.mean_cube(), 0.05 * 0.05 * 0.05);
  EXPECT_DOUBLE_EQ(d.fines_fraction(), 0);
}

void expect_refused(const SizeDistributionConfig& c, const std::string& key) {
  try {
    const SizeDistribution d(c);
    FAIL() << "accepted, but '" << key << "' is wrong";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().key, key);
    EXPECT_FALSE(error.problems().front().suggestion.empty());
  }
}

TEST(SizeDistribution, RefusesACurveThatFalls) {
  SizeDistributionConfig c = worked_curve(SizeInterpolation::linear);
  std::swap(c.points[4].passing, c.points[5].passing);
  expect_refused(c, "points");
}

TEST(SizeDistribution, RefusesPassingBeyondOne) {
  SizeDistributionConfig c = worked_curve(SizeInterpolation::linear);
  c.points.back().passing = 1.1;
  expect_refused(c, "points");
}

TEST(SizeDistribution, RefusesACurveThatDoesNotReachAll) {
  SizeDistributionConfig c = worked_curve(SizeInterpolation::linear);
  c.points.back().passing = 0.98;
  expect_refused(c, "points");
}

TEST(SizeDistribution, RefusesACutOffAboveTheTopSize) {
  SizeDistributionConfig c = worked_curve(SizeInterpolation::linear);
  c.cutoff = 0.2;
  expect_refused(c, "cutoff");
}

TEST(SizeDistribution, RefusesACurveWithoutFinestSizeOrCutOff) {
  SizeDistributionConfig c = worked_curve(SizeInterpolation::log_linear);
  c.cutoff = 0;
  expect_refused(c, "cutoff");
}

TEST(SizeDistribution, RefusesRosinRammlerWithoutSpread) {
  SizeDistributionConfig c;
  c.curve = SizeCurve::rosin_rammler;
  c.d63 = 0.04;
  c.cutoff = 1e-3;
  expect_refused(c, "spread");
}

TEST(SizeDistributionKeys, ReportTheSameProblems) {
  test::MapSchema s;
  s.words["curve"] = "rosin_rammler";
  s.numbers_given["d63"] = 0.04;
  SizeDistributionConfig c;
  c.keys(s);
  EXPECT_TRUE(s.complains_about("spread"));
  EXPECT_TRUE(s.complains_about("cutoff"));
  EXPECT_FALSE(s.complains_about("d63"));
}

}  // namespace
}  // namespace sluice
