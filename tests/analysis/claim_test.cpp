#include "analysis/claim.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace sluice {
namespace {

const std::vector<double> base{1.0, 1.2, 0.9, 1.1, 0.8};

std::vector<double> shifted(double by, double noise = 0.01) {
  std::vector<double> out;
  for (std::size_t i = 0; i < base.size(); ++i) out.push_back(base[i] + by + (i % 2 == 0 ? noise : -noise));
  return out;
}

TEST(Claim, OfALowerResultHoldsWherePairsDifferMoreThanTheyScatter) {
  // The two overlap as lots, but seed by seed one lies below the other.
  EXPECT_EQ(judge_claim(ClaimKind::lower, shifted(-0.1), base, 0).verdict, ClaimVerdict::holds);
  EXPECT_EQ(judge_claim(ClaimKind::lower, shifted(0.1), base, 0).verdict, ClaimVerdict::does_not_hold);
  EXPECT_EQ(judge_claim(ClaimKind::lower, shifted(-0.01, 0.1), base, 0).verdict, ClaimVerdict::not_shown);
}

TEST(Claim, OfLikenessHoldsWithinItsMarginOnly) {
  EXPECT_EQ(judge_claim(ClaimKind::alike, shifted(0.02), base, 0.1).verdict, ClaimVerdict::holds);
  EXPECT_EQ(judge_claim(ClaimKind::alike, shifted(0.3), base, 0.1).verdict, ClaimVerdict::does_not_hold);
  EXPECT_EQ(judge_claim(ClaimKind::alike, shifted(-0.3), base, 0.1).verdict, ClaimVerdict::does_not_hold);
  EXPECT_EQ(judge_claim(ClaimKind::alike, shifted(0.08, 0.1), base, 0.1).verdict, ClaimVerdict::not_shown);
}

TEST(Claim, NeedsFiveSeeds) {
  EXPECT_EQ(judge_claim(ClaimKind::lower, {1, 1, 1, 1}, {2, 2, 2, 2}, 0).verdict,
            ClaimVerdict::too_few_values);
  EXPECT_EQ(judge_claim(ClaimKind::lower, {1, 1, 1, 1, std::nan("")}, {2, 2, 2, 2, 2}, 0).verdict,
            ClaimVerdict::too_few_values);
}

TEST(Claim, IsSeldomMadeOfTwoEqualDesigns) {
  Random random(31);
  int holds = 0;
  for (int k = 0; k < 4000; ++k) {
    std::vector<double> a, b;
    for (int i = 0; i < 5; ++i) {
      a.push_back(random.normal());
      b.push_back(random.normal());
    }
    holds += judge_claim(ClaimKind::lower, a, b, 0).verdict == ClaimVerdict::holds ? 1 : 0;
  }
  // One side of 95 % limits: 2.5 % of 4000, three standard errors of 10.
  EXPECT_NEAR(holds, 100, 30);
}

}  // namespace
}  // namespace sluice
