#include "analysis/residence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sluice {
namespace {

TEST(ResidenceTimes, GiveTheWorkedMoments) {
  // analysis_rtd_worked.json: tracer pulse, trapezoidal rule.
  const std::vector<double> t{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14};
  const std::vector<double> c{0, 1, 5, 8, 10, 8, 6, 4, 3, 2.2, 1.5, 0.6, 0};
  std::vector<double> weight;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double before = i == 0 ? 0 : t[i] - t[i - 1], after = i + 1 == t.size() ? 0 : t[i + 1] - t[i];
    weight.push_back(0.5 * (before + after) * c[i]);
  }
  const ResidenceTimes r = residence_times(t, weight);
  EXPECT_NEAR(r.mean, 5.127344521224086, 1e-12);
  EXPECT_NEAR(r.variance, 5.95120686748479, 1e-12);
  EXPECT_NEAR(r.tanks, 4.417534531182862, 1e-12);
}

TEST(ResidenceTimes, OfPlugFlowHaveNoSpread) {
  const ResidenceTimes r = residence_times({2, 2, 2}, {1, 5, 3});
  EXPECT_DOUBLE_EQ(r.mean, 2);
  EXPECT_NEAR(r.variance, 0, 1e-15);
  EXPECT_DOUBLE_EQ(r.t90, 2);
}

TEST(ResidenceTimes, ComeFromThePassagesInTheWindow) {
  ExitConfig c;
  c.low = Vec3(1, 0, 0);
  c.high = Vec3(1, 1, 1);
  ExitTally tally(c, 0.1);
  tally.add({.t = 1, .mass = 1, .size = 0.1, .birth = 0.8, .rock = true});
  tally.add({.t = 2, .mass = 1, .size = 0.1, .birth = 1.0, .rock = true});
  tally.add({.t = 2.5, .mass = 3, .size = 0.1, .birth = 0.5, .rock = true});
  EXPECT_NEAR(residence_times(tally, 1.5, 3).mean, (1 + 3 * 2) / 4.0, 1e-12);
  EXPECT_TRUE(std::isnan(residence_times(tally, 5, 6).mean));
}

}  // namespace
}  // namespace sluice
