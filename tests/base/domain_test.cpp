#include "base/domain.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace sluice {
namespace {

Domain channel() {
  Domain d;
  d.box = {Vec3(-1, 0, 0), Vec3(2, 1, 1)};
  d.low[0] = d.high[0] = Face::periodic;
  d.low[1] = d.high[1] = Face::wall;
  return d;
}

TEST(Domain, WrapsIntoTheBoxAlongPeriodicAxesOnly) {
  const Domain d = channel();
  EXPECT_EQ(d.wrapped({2.5, 0.5, 0.5}), Vec3(-0.5, 0.5, 0.5));
  EXPECT_EQ(d.wrapped({-1.5, 0.5, 0.5}), Vec3(1.5, 0.5, 0.5));
  EXPECT_EQ(d.wrapped({2.0, 7.0, -3.0}), Vec3(-1.0, 7.0, -3.0));
}

TEST(Domain, WrappedPositionsLieInTheHalfOpenBox) {
  const Domain d = channel();
  Random r(5);
  for (int i = 0; i < 10000; ++i) {
    const double x = d.wrapped({r.uniform(-30, 30), 0, 0}).x();
    ASSERT_GE(x, -1.0);
    ASSERT_LT(x, 2.0);
  }
  // Just below the low face: rounding would give the high face itself.
  EXPECT_LT(d.wrapped({std::nextafter(-1.0, -2.0), 0, 0}).x(), 2.0);
}

TEST(Domain, NearestImageIsAtMostHalfALengthAway) {
  const Domain d = channel();
  Random r(6);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 apart(r.uniform(-3, 3), r.uniform(-1, 1), r.uniform(-1, 1));
    const Vec3 nearest = d.nearest_image(apart);
    ASSERT_LE(std::abs(nearest.x()), 1.5);
    ASSERT_EQ(nearest.y(), apart.y());
    const double turns = (apart.x() - nearest.x()) / 3.0;
    ASSERT_NEAR(turns, std::round(turns), 1e-14);
  }
}

TEST(Domain, OutsideIsBeyondAFaceThatIsNotPeriodic) {
  const Domain d = channel();
  EXPECT_FALSE(d.outside({50, 0.5, 0.5}));
  EXPECT_TRUE(d.outside({0, -0.1, 0.5}));
  EXPECT_TRUE(d.outside({0, 0.5, 1.1}));
  EXPECT_FALSE(d.outside({0, 1.0, 1.0}));
  EXPECT_TRUE(d.any_periodic());
}

TEST(Box, GrowsAroundWhatItIncludes) {
  Box box;
  EXPECT_TRUE(box.empty());
  box.include(Vec3(1, 2, 3));
  EXPECT_FALSE(box.empty());
  box.include(Vec3(-1, 4, 0));
  EXPECT_EQ(box.size(), Vec3(2, 2, 3));
  EXPECT_EQ(box.centre(), Vec3(0, 3, 1.5));
  EXPECT_TRUE(box.contains({0, 3, 1}));
  EXPECT_FALSE(box.contains({0, 5, 1}));
  EXPECT_TRUE(box.grown(1).contains({0, 5, 1}));
  EXPECT_TRUE(box.overlaps({Vec3(1, 2, 3), Vec3(9, 9, 9)}));
  EXPECT_FALSE(box.overlaps({Vec3(1.1, 2, 3), Vec3(9, 9, 9)}));
}

TEST(TangentFrame, IsRightHandedForEveryDirection) {
  Random r(8);
  std::vector<Vec3> normals{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), -Vec3::UnitZ()};
  for (int i = 0; i < 1000; ++i) normals.push_back(r.on_sphere());
  for (const Vec3& n : normals) {
    const auto [e1, e2] = tangent_frame(n);
    ASSERT_LT((e1.cross(e2) - n).norm(), 1e-14);
    ASSERT_NEAR(e1.norm(), 1.0, 1e-14);
    ASSERT_NEAR(e1.dot(n), 0.0, 1e-14);
  }
}

}  // namespace
}  // namespace sluice
