#include "analysis/confidence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace sluice {
namespace {

TEST(StudentT, MatchesTheTables) {
  // Abramowitz & Stegun, table 26.10.
  EXPECT_NEAR(student_t_975(3), 3.182, 0.03);
  EXPECT_NEAR(student_t_975(10), 2.228, 0.001);
  EXPECT_NEAR(student_t_975(19), 2.093, 0.001);
}

TEST(BatchMean, CoversTheTruthAboutAsOftenAsItSays) {
  Random random(4);
  int covered = 0;
  for (int run = 0; run < 1000; ++run) {
    std::vector<double> series;
    for (int i = 0; i < 200; ++i) series.push_back(5 + random.normal());
    const Estimate e = batch_mean(series);
    covered += std::abs(e.value - 5) <= e.half_width ? 1 : 0;
  }
  // 950 +- 3 standard errors of 7.
  EXPECT_NEAR(covered, 950, 21);
}

TEST(BatchMean, HasNoLimitsForAShortSeries) {
  EXPECT_TRUE(std::isnan(batch_mean({1, 2, 3}).half_width));
  EXPECT_DOUBLE_EQ(batch_mean({1, 2, 3}).value, 2);
  EXPECT_TRUE(std::isnan(batch_mean({}).value));
}

TEST(JackknifeHalfWidth, OfAMeanIsThatOfBatchMeans) {
  Random random(9);
  std::vector<double> series;
  for (int i = 0; i < 60; ++i) series.push_back(random.normal());
  double sum = 0;
  for (double x : series) sum += x;
  std::vector<double> without;
  for (int b = 0; b < 20; ++b)
    without.push_back((sum - series[3 * b] - series[3 * b + 1] - series[3 * b + 2]) / 57);
  EXPECT_NEAR(jackknife_half_width(without), batch_mean(series).half_width, 1e-13);
}

TEST(JackknifeHalfWidth, IsUnknownWhereTheFigureIs) {
  EXPECT_TRUE(std::isnan(jackknife_half_width({1, 2, 3})));
  EXPECT_TRUE(std::isnan(jackknife_half_width({1, 2, 3, std::nan("")})));
}

TEST(ReplicateMean, GivesTheWorkedLimits) {
  // Mean 5, standard deviation sqrt(10), t(0.975, 4) = 2.776 (Abramowitz & Stegun, table 26.10).
  const Estimate e = replicate_mean({1, 3, 5, 7, 9});
  EXPECT_DOUBLE_EQ(e.value, 5);
  EXPECT_NEAR(e.half_width, 2.776 * std::sqrt(10.0 / 5), 0.01 * 3.93);
  EXPECT_TRUE(std::isnan(replicate_mean({1, 2, 3}).half_width));
}

TEST(WeightedQuantile, IsTheValueOfASingleRock) {
  EXPECT_EQ(weighted_quantile({0.05}, {3}, 0.8), 0.05);
}

TEST(WeightedQuantile, WeighsByMassNotByNumber) {
  // Ninety small rocks of 1 kg, one of 910 kg: P50 lies in the large one.
  std::vector<double> size(90, 0.01), mass(90, 1);
  size.push_back(0.1);
  mass.push_back(910);
  EXPECT_NEAR(weighted_quantile(size, mass, 0.5), 0.1, 0.011);
  EXPECT_EQ(weighted_quantile(size, mass, 0.6), 0.1);
  EXPECT_EQ(weighted_quantile(size, mass, 0.05), 0.01);
}

TEST(WeightedQuantile, ConvergesToTheCurve) {
  std::vector<double> value, mass(1000, 2.0);
  for (int i = 0; i < 1000; ++i) value.push_back(1 - (i + 0.5) / 1000);
  EXPECT_NEAR(weighted_quantile(value, mass, 0.8), 0.8, 1e-12);
  EXPECT_NEAR(weighted_quantile(value, mass, 0.1), 0.1, 1e-12);
}

}  // namespace
}  // namespace sluice
