#include "analysis/convergence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace sluice {
namespace {

LadderPoint at(double h, double value, double half_width = 0) {
  return {h, value, half_width};
}

TEST(Change, IsResolvedBeyondThreeTimesItsLimits) {
  EXPECT_EQ(change_between(at(2, 1.0, 0.03), at(1, 1.2, 0.03)).verdict, ChangeVerdict::resolved);
  EXPECT_EQ(change_between(at(2, 1.0, 0.1), at(1, 1.2, 0.1)).verdict, ChangeVerdict::changed);
}

TEST(Change, IsBoundedWhereItsLimitsAreNarrow) {
  const Change c = change_between(at(2, 1.00, 0.03), at(1, 1.02, 0.04));
  EXPECT_EQ(c.verdict, ChangeVerdict::bounded);
  EXPECT_NEAR(c.half_width, 0.05, 1e-15);
}

TEST(Change, IsNotToldBySamplingThatIsTooShort) {
  EXPECT_EQ(change_between(at(2, 0.21, 0.1), at(1, 0.22, 0.1)).verdict, ChangeVerdict::too_short);
}

TEST(Change, IsUnknownWithoutLimits) {
  EXPECT_EQ(change_between(at(2, 1, std::nan("")), at(1, 2, 0.1)).verdict, ChangeVerdict::unknown);
  EXPECT_EQ(change_between(at(2, std::nan("")), at(1, 2)).verdict, ChangeVerdict::unknown);
}

TEST(Change, OfTwoSamplesOfOneFlowIsSeldomResolved) {
  Random random(21);
  int resolved = 0, beyond = 0;
  for (int k = 0; k < 2000; ++k) {
    // 95 % limits of a normal value are 1.96 standard deviations.
    const Change c = change_between(at(2, 5 + random.normal(), 1.96), at(1, 5 + random.normal(), 1.96));
    resolved += c.verdict == ChangeVerdict::resolved ? 1 : 0;
    beyond += std::abs(c.value) > c.half_width ? 1 : 0;
  }
  EXPECT_EQ(resolved, 0);
  EXPECT_NEAR(beyond, 100, 3 * 9.75);
}

TEST(Extrapolation, FindsTheOrderOfAPowerLawOnUnequalRatios) {
  Random random(22);
  for (int k = 0; k < 50; ++k) {
    const double p = random.uniform(0.6, 2), exact = random.uniform(-3, 3), c = random.uniform(0.2, 2);
    std::vector<LadderPoint> points;
    for (const double h : {0.09, 0.05, 0.03}) points.push_back(at(h, exact + c * std::pow(h, p)));
    const auto found = extrapolate(points);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->order, p, 1e-9);
    EXPECT_NEAR(found->value, exact, 1e-9);
    EXPECT_NEAR(found->index, 1.25 * c * std::pow(0.03, p), 1e-9);
  }
}

TEST(Extrapolation, TakesALargerSettingAsFinerWhereSettingsGrow) {
  std::vector<LadderPoint> points;
  for (const double n : {10.0, 20.0, 40.0}) points.push_back(at(n, 2 + 3 / n));
  const auto found = extrapolate(points);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->order, 1, 1e-9);
  EXPECT_NEAR(found->value, 2, 1e-9);
}

TEST(Extrapolation, IsNotGivenWhereSamplingHidesTheDifferences) {
  EXPECT_FALSE(extrapolate({at(4, 1.4, 0.05), at(2, 1.2, 0.05), at(1, 1.1, 0.05)}));
}

TEST(Extrapolation, IsNotGivenForAResultThatSwings) {
  EXPECT_FALSE(extrapolate({at(4, 1.4), at(2, 1.0), at(1, 1.2)}));
  EXPECT_FALSE(extrapolate({at(4, 1.1), at(2, 1.2), at(1, 1.4)}));  // it runs away
  EXPECT_FALSE(extrapolate({at(4, 1.1), at(2, 1.2)}));
}

}  // namespace
}  // namespace sluice
