#include "geometry/exact_sign.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace sluice {
namespace {

TEST(ExactSign, OfCoplanarPointsIsZeroWhateverTheRounding) {
  // x + y + z = 3 * 2^-20 k in numbers that are exact but whose products are not.
  Random random(7);
  for (int trial = 0; trial < 2000; ++trial) {
    Vec3 p[4];
    for (Vec3& x : p) {
      const double i = std::floor(random.uniform(0, 1 << 26)), j = std::floor(random.uniform(0, 1 << 26));
      x = Vec3(i, j, (1 << 28) - i - j) / 1048576.0;
    }
    ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3]), 0);
  }
}

TEST(ExactSign, SeesOneUnitInTheLastPlace) {
  const Vec3 a(0.1, 0.1, 0.1), b(0.7, 0.2, 0.1), c(0.3, 0.9, 0.1);
  const Vec3 above(0.4, 0.4, std::nextafter(0.1, 1.0)), below(0.4, 0.4, std::nextafter(0.1, 0.0));
  EXPECT_GT(orient3d(a, b, c, above), 0);
  EXPECT_LT(orient3d(a, b, c, below), 0);
  EXPECT_EQ(orient3d(a, b, c, Vec3(0.4, 0.4, 0.1)), 0);
}

TEST(ExactSign, IsAntisymmetricNearZero) {
  Random random(3);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 a = random.on_sphere(), b = random.on_sphere(), c = random.on_sphere();
    const Vec3 d = a + random.uniform() * (b - a) + random.uniform() * (c - a);  // coplanar to rounding
    const double one = orient3d(a, b, c, d), other = orient3d(b, a, c, d), turned = orient3d(d, c, b, a);
    ASSERT_EQ(one > 0, other < 0);
    ASSERT_EQ(one<0, other> 0);
    ASSERT_EQ(one > 0, turned > 0);  // reversal of four is an even permutation
  }
}

TEST(ExactSign, InThePlaneFindsCollinearPoints) {
  for (int k = 1; k < 1000; ++k) {
    const Eigen::Vector2d a(0.5 / 1024, 12.0 + 1.0 / 1024), step(3.0 / 1024, 7.0 / 1024);
    ASSERT_EQ(orient2d(a, a + 1024 * step, a + k * step), 0);
  }
  EXPECT_GT(orient2d({0, 0}, {1, 0}, {0.3, 1e-300}), 0);
}

}  // namespace
}  // namespace sluice
