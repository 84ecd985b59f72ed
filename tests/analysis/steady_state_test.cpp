#include "analysis/steady_state.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace sluice {
namespace {

constexpr double interval = 0.05;  // [s]

/// Rises to `level` with time constant 2 s, under noise.
std::vector<double> start_up(std::size_t n, double level, double noise, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> y;
  for (std::size_t i = 0; i < n; ++i)
    y.push_back(level * (1 - std::exp(-interval * static_cast<double>(i) / 2)) + noise * random.normal());
  return y;
}

TEST(SteadyState, StartsAfterTheRise) {
  const SteadyState s = find_steady_state({{"rock out", start_up(1600, 100, 5, 1)}}, interval, 2);
  ASSERT_TRUE(s.from) << s.reason;
  EXPECT_GT(*s.from, 3);
  EXPECT_LT(*s.from, 20);
  EXPECT_EQ(s.reason, "");
}

TEST(SteadyState, WaitsForTheSlowestSignal) {
  const auto quick = find_steady_state({{"water", std::vector<double>(1600, 4.0)}}, interval, 2);
  ASSERT_TRUE(quick.from);
  EXPECT_EQ(*quick.from, 0);
  const auto both = find_steady_state(
      {{"water", std::vector<double>(1600, 4.0)}, {"rock", start_up(1600, 100, 5, 1)}}, interval, 2);
  ASSERT_TRUE(both.from);
  EXPECT_GT(*both.from, 3);
}

void expect_not_steady(const std::vector<double>& values, double residence, const std::string& words) {
  const SteadyState s = find_steady_state({{"rock out", values}}, interval, residence);
  EXPECT_FALSE(s.from);
  EXPECT_NE(s.reason.find(words), std::string::npos) << s.reason;
  EXPECT_NE(s.reason.find("rock out"), std::string::npos);
}

TEST(SteadyState, IsNotReachedInAShortRun) {
  expect_not_steady(std::vector<double>(10, 1.0), 1, "too few");
  expect_not_steady(start_up(400, 100, 5, 2), 5, "residence times");
}

TEST(SteadyState, IsNotReachedWhileItStillRises) {
  std::vector<double> y;
  for (int i = 0; i < 1000; ++i) y.push_back(i);
  const SteadyState s = find_steady_state({{"rock out", y}}, interval, 0);
  EXPECT_FALSE(s.from);
}

TEST(SteadyState, IsNotReachedBeforeAnythingCame) {
  expect_not_steady(std::vector<double>(1000, 0.0), 0, "nothing came");
}

TEST(SteadyState, NeedsManySwings) {
  std::vector<double> y;
  Random random(3);
  double x = 0;
  for (int i = 0; i < 1000; ++i) {  // correlation time 50 slots
    x = 0.98 * x + random.normal();
    y.push_back(100 + x);
  }
  const SteadyState s = find_steady_state({{"rock out", y}}, interval, 0);
  EXPECT_FALSE(s.from);
}

TEST(SteadyState, SaysThatThereIsNothingToJudge) {
  EXPECT_FALSE(find_steady_state({}, interval, 1).from);
}

TEST(CorrelationTime, OfAnAutoregressiveSeriesIsItsClosedForm) {
  // Sum of 0.9^k from 1 on is 9, and a half.
  Random random(9);
  std::vector<double> y;
  double x = 0;
  for (int i = 0; i < 40000; ++i) {
    x = 0.9 * x + random.normal();
    y.push_back(x);
  }
  EXPECT_NEAR(correlation_time(y), 9.5, 1.5);
}

TEST(Mser, CutsAStepWhereItIs) {
  std::vector<double> y(300, 10.0);
  for (std::size_t i = 0; i < 60; ++i) y[i] = 0;
  EXPECT_EQ(mser_cut(y), 60u);
}

}  // namespace
}  // namespace sluice
