#include "base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace sluice {
namespace {

constexpr int draws = 200000;

TEST(Random, FollowsThePublishedGenerator) {
  // First six outputs of pcg32 with initstate 42, initseq 54 (O'Neill 2014, pcg32-demo).
  Random random;
  random.increment = (54u << 1) | 1u;
  random.state = 0;
  random.next();
  random.state += 42;
  random.next();
  for (std::uint32_t wanted : {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu})
    EXPECT_EQ(random.next(), wanted);
}

TEST(Random, GoesOnFromItsSavedState) {
  Random a(7);
  for (int i = 0; i < 10; ++i) a.next();
  Random b;
  b.state = a.state;
  b.increment = a.increment;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.next(), b.next());
}

TEST(Random, StreamsAndSeedsDiffer) {
  std::set<std::uint64_t> firsts;
  for (std::uint64_t seed = 0; seed < 30; ++seed)
    for (std::uint64_t stream = 0; stream < 30; ++stream) {
      Random r(seed, stream);
      firsts.insert((static_cast<std::uint64_t>(r.next()) << 32) | r.next());
    }
  EXPECT_EQ(firsts.size(), 900u);
}

TEST(Random, UniformHasTheMomentsOfAUniform) {
  Random r(1);
  double sum = 0, squares = 0;
  for (int i = 0; i < draws; ++i) {
    const double u = r.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    squares += u * u;
  }
  // Five standard errors of the mean of u and of u^2.
  EXPECT_NEAR(sum / draws, 0.5, 5 * std::sqrt(1.0 / 12 / draws));
  EXPECT_NEAR(squares / draws, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / draws));
}

TEST(Random, NormalHasMeanZeroAndVarianceOne) {
  Random r(2);
  double sum = 0, squares = 0, fourths = 0;
  for (int i = 0; i < draws; ++i) {
    const double x = r.normal();
    ASSERT_TRUE(std::isfinite(x));
    sum += x;
    squares += x * x;
    fourths += x * x * x * x;
  }
  EXPECT_NEAR(sum / draws, 0.0, 5 / std::sqrt(draws));
  EXPECT_NEAR(squares / draws, 1.0, 5 * std::sqrt(2.0 / draws));
  EXPECT_NEAR(fourths / draws, 3.0, 5 * std::sqrt(96.0 / draws));
}

TEST(Random, DirectionsAreUnitAndEven) {
  Random r(3);
  Vec3 sum = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (int i = 0; i < draws; ++i) {
    const Vec3 d = r.on_sphere();
    ASSERT_NEAR(d.norm(), 1.0, 1e-14);
    sum += d;
    second += d * d.transpose();
  }
  EXPECT_LT((sum / draws).norm(), 6 / std::sqrt(draws));
  EXPECT_LT((second / draws - Mat3::Identity() / 3).cwiseAbs().maxCoeff(), 6 * std::sqrt(4.0 / 45 / draws));
}

TEST(Random, RotationsTurnAFixedVectorEvenly) {
  Random r(4);
  Mat3 second = Mat3::Zero();
  for (int i = 0; i < draws; ++i) {
    const Quat q = r.rotation();
    ASSERT_NEAR(q.norm(), 1.0, 1e-14);
    const Vec3 d = q * Vec3(0.6, 0.0, 0.8);
    second += d * d.transpose();
  }
  EXPECT_LT((second / draws - Mat3::Identity() / 3).cwiseAbs().maxCoeff(), 6 * std::sqrt(4.0 / 45 / draws));
}

}  // namespace
}  // namespace sluice
