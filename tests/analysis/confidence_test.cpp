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
