#include "reports/format.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sluice {
namespace {

TEST(NumberWithLimits, RoundsTheValueToThePlaceOfItsLimits) {
  EXPECT_EQ(number_with_limits(0.2134, 0.0221), "0.21 \u00b1 0.02");
  EXPECT_EQ(number_with_limits(0.2134, 0.0121), "0.213 \u00b1 0.012");
  EXPECT_EQ(number_with_limits(1203.7, 31), "1200 \u00b1 30");
  EXPECT_EQ(number_with_limits(5, 0), "5.00 \u00b1 0");
}

TEST(NumberWithLimits, IsTheValueAloneWithoutLimits) {
  EXPECT_EQ(number_with_limits(0.2134, std::nan("")), "0.213");
  EXPECT_EQ(number_with_limits(std::nan(""), 0.1), "\u2013");
}

}  // namespace
}  // namespace sluice
