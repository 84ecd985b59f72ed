#include "base/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sluice {
namespace {

TEST(Statistics, MeanAndVarianceOfAShortList) {
  const std::vector<double> x{1, 2, 4, 9};
  EXPECT_DOUBLE_EQ(mean(x), 4.0);
  EXPECT_DOUBLE_EQ(variance(x), 38.0 / 3.0);
  EXPECT_EQ(mean({}), 0.0);
  EXPECT_EQ(variance({5.0}), 0.0);
}

TEST(Statistics, QuantilesInterpolateBetweenSortedValues) {
  const std::vector<double> x{30, 10, 20, 40};
  EXPECT_DOUBLE_EQ(quantile(x, 0.0), 10.0);
  EXPECT_DOUBLE_EQ(quantile(x, 1.0), 40.0);
  EXPECT_DOUBLE_EQ(quantile(x, 0.5), 25.0);
  EXPECT_DOUBLE_EQ(quantile(x, 0.25), 17.5);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(Histogram, QuantilesAreWithinABinOfTheTruth) {
  Histogram h(0.0, 1.0, 200);
  for (int i = 0; i < 10000; ++i) h.add((i + 0.5) / 10000.0);
  for (double q : {0.01, 0.25, 0.5, 0.99}) EXPECT_NEAR(h.quantile(q), q, 1.0 / 200);
  EXPECT_DOUBLE_EQ(h.total(), 10000.0);
}

TEST(Histogram, WeightsCount) {
  Histogram h(0.0, 10.0, 10);
  h.add(2.5, 1.0);
  h.add(7.5, 9.0);
  EXPECT_GE(h.quantile(0.5), 7.0);
  EXPECT_LE(h.quantile(0.05), 3.0);
  EXPECT_DOUBLE_EQ(h.total(), 10.0);
}

TEST(Histogram, ValuesBeyondTheEndsFallIntoTheEndBins) {
  Histogram h(0.0, 1.0, 4);
  h.add(-5.0);
  h.add(99.0);
  EXPECT_EQ(h.counts().front(), 1.0);
  EXPECT_EQ(h.counts().back(), 1.0);
}

TEST(Histogram, AnEmptyOneHasNoTotal) {
  Histogram h;
  h.add(1.0);
  EXPECT_EQ(h.total(), 0.0);
}

}  // namespace
}  // namespace sluice
