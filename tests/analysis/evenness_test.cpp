#include "analysis/evenness.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sluice {
namespace {

TEST(Evenness, GivesTheWorkedVariation) {
  // analysis_mixing_worked.json, "width": sample coefficient of variation 0.29345589.
  const std::vector<double> mass{3.1, 4.0, 5.2, 6.1, 6.4, 6.0, 5.1, 4.2, 3.2, 2.7};
  const Evenness e = evenness(mass, std::vector<double>(10, 0.0));
  EXPECT_NEAR(e.raw, 0.2934558946567621, 1e-12);
  EXPECT_EQ(e.floor, 0);
  EXPECT_EQ(e.corrected, e.raw);
}

TEST(Evenness, OfAFlowWithinItsShotNoiseHasLimitsAboveZero) {
  // raw below its floor: the corrected figure is 0, but nobody knows it to be exactly 0.
  Evenness e{0.10, 0.12, 0};
  std::vector<Evenness> without;
  for (int b = 0; b < 20; ++b) without.push_back({0.10 + 0.0004 * (b - 9.5), 0.12, 0});
  set_limits(e, without);
  EXPECT_GT(e.raw_half_width, 0);
  EXPECT_GE(e.corrected_half_width, 0);
  e = {0.12, 0.12, 0};
  for (Evenness& w : without) w.raw += 0.02;
  set_limits(e, without);
  EXPECT_GT(e.corrected_half_width, 0);
}

TEST(Evenness, HasNoLimitsWithoutBatches) {
  Evenness e{0.3, 0.1, 0.28};
  set_limits(e, {});
  EXPECT_TRUE(std::isnan(e.raw_half_width));
  EXPECT_TRUE(std::isnan(e.corrected_half_width));
}

}  // namespace
}  // namespace sluice
