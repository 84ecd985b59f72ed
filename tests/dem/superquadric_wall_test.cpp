#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "dem/rock_shape.h"
#include "dem/superquadric_contact.h"

namespace sluice {
namespace {

Vec3 random_axes(Random& random) {
  const double b = random.uniform(0.01, 0.03);
  return {b * random.uniform(1, 2), b, b / random.uniform(1, 2)};
}

/// n.(p - centre) - h(n): the gap between the body and what lies at p, along n.
double gap_along(const Superquadric& body, const Vec3& p, const Vec3& n) {
  return n.dot(p - body.x) - support_height(body.semi_axes, body.m, body.q.conjugate() * n);
}

constexpr double kBlockiness[] = {2, 2.5, 3, 4, 5.5, 6, 8, 16};

/// A body and a point `overlap` below its surface, where the surface's normal is n.
struct Poke {
  Superquadric body;
  Vec3 p = Vec3::Zero(), n = Vec3::Zero();
  double overlap = 0;
};

Poke random_poke(Random& random, double m) {
  Poke poke;
  poke.body = {random.on_sphere(), random.rotation(), random_axes(random), m};
  poke.n = random.on_sphere();
  poke.overlap = 0.2 * poke.body.semi_axes.minCoeff() * std::pow(random.uniform(0.1, 1), 3);
  poke.p = poke.body.x - poke.overlap * poke.n +
           poke.body.q * support_point(poke.body.semi_axes, m, poke.body.q.conjugate() * poke.n);
  return poke;
}

TEST(SuperquadricPlane, IsTheSupportPointAgainstThePlane) {
  Random random(1);
  for (const double m : kBlockiness)
    for (int i = 0; i < 100; ++i) {
      const Poke poke = random_poke(random, m);
      const ContactGeometry geometry = superquadric_plane(poke.body, poke.p, -poke.n);
      EXPECT_NEAR(geometry.overlap, poke.overlap, 1e-15);
      EXPECT_EQ(geometry.normal, poke.n);
      EXPECT_LT((geometry.point - poke.p - 0.5 * poke.overlap * poke.n).norm(),
                1e-8 * poke.body.semi_axes.x());
    }
}

TEST(SuperquadricPlane, OfASphereIsTheSphereFormulaAlsoApart) {
  const Superquadric sphere{Vec3(0.1, 0.2, 0.3), Quat(0.3, 0.1, 0.9, 0.2).normalized(), Vec3::Constant(0.05),
                            2};
  const ContactGeometry apart = superquadric_plane(sphere, Vec3(5, 5, 0.2), Vec3::UnitZ());
  EXPECT_NEAR(apart.overlap, -0.05, 1e-15);
  EXPECT_LT((apart.point - Vec3(0.1, 0.2, 0.225)).norm(), 1e-15);
}

TEST(SuperquadricSegment, OfASphereIsTheSphereFormula) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Superquadric sphere{random.on_sphere(), random.rotation(), Vec3::Constant(0.05), 2};
    const Vec3 n = random.on_sphere();
    const Vec3 u = tangent_frame(n)[0];
    const Vec3 foot = sphere.x + 0.045 * n;
    Vec3 start = Vec3::Zero();
    ContactGeometry geometry;
    ASSERT_TRUE(superquadric_segment(sphere, foot - 0.1 * u, foot + 0.3 * u, start, geometry));
    EXPECT_NEAR(geometry.overlap, 0.005, 1e-13);
    EXPECT_LT((geometry.normal - n).norm(), 1e-9);
    EXPECT_LT((geometry.point - sphere.x - 0.0475 * n).norm(), 1e-10);
  }
}

TEST(SuperquadricSegment, FindsTheLineUnderTheSurfaceColdAndWarm) {
  Random random(3);
  for (const double m : kBlockiness) {
    int missed = 0, other_branch = 0;
    constexpr int kTried = 2000;
    for (int i = 0; i < kTried; ++i) {
      Poke poke = random_poke(random, m);
      const auto [t1, t2] = tangent_frame(poke.n);
      const double turn = random.uniform(0, 6.28);
      const Vec3 u = std::cos(turn) * t1 + std::sin(turn) * t2;
      const double before = random.uniform(0.2, 0.5), after = random.uniform(0.2, 0.5);
      Vec3 start = Vec3::Zero();
      for (int step = 0; step < 3; ++step) {
        ContactGeometry geometry;
        if (!superquadric_segment(poke.body, poke.p - before * u, poke.p + after * u, start, geometry)) {
          ASSERT_GT(step, 0) << m;
          ++missed;
          break;
        }
        // The overlap is the gap along its normal, which is normal to the line; none near it is larger.
        EXPECT_NEAR(geometry.normal.dot(u), 0, 1e-9);
        EXPECT_NEAR(gap_along(poke.body, poke.p, geometry.normal), -geometry.overlap, 1e-10);
        for (const double side : {-1e-3, 1e-3})
          EXPECT_LE(
              gap_along(poke.body, poke.p, (geometry.normal + side * u.cross(geometry.normal)).normalized()),
              -geometry.overlap + 1e-11);
        // Deeper than the least radius of curvature (corners) another branch is the right one.
        if (step == 0 && poke.overlap < 0.02 * poke.body.semi_axes.minCoeff())
          other_branch += std::fabs(geometry.overlap - poke.overlap) > 1e-10;
        const Vec3 move = 1e-5 * random.on_sphere();
        poke.body.x += move;
        poke.body.q = (poke.body.q * Quat(Eigen::AngleAxisd(2e-4, random.on_sphere()))).normalized();
      }
    }
    EXPECT_LE(missed, kTried / 10) << m;  // moved out of touch
    EXPECT_EQ(other_branch, 0) << m;
  }
}

TEST(SuperquadricSegment, IsNotTouchedBeyondItsEndsOrApart) {
  const Superquadric body{Vec3::Zero(), Quat::Identity(), Vec3(0.03, 0.02, 0.01), 4};
  Vec3 start = Vec3::Zero();
  ContactGeometry geometry;
  EXPECT_TRUE(superquadric_segment(body, Vec3(-1, 0, 0.009), Vec3(1, 0, 0.009), start, geometry));
  EXPECT_NEAR(geometry.overlap, 0.001, 1e-12);
  EXPECT_LT((geometry.normal - Vec3::UnitZ()).norm(), 1e-9);
  start.setZero();
  EXPECT_FALSE(superquadric_segment(body, Vec3(0.1, 0, 0.009), Vec3(1, 0, 0.009), start, geometry));
  start.setZero();
  EXPECT_FALSE(superquadric_segment(body, Vec3(-1, 0, 0.0101), Vec3(1, 0, 0.0101), start, geometry));
  start.setZero();
  EXPECT_FALSE(superquadric_segment(body, Vec3(-1, 0, 0.5), Vec3(1, 0, 0.5), start, geometry));
}

TEST(SuperquadricPoint, OfASphereIsTheSphereFormula) {
  const Superquadric sphere{Vec3(0.1, 0.2, 0.3), Quat(0.3, 0.1, 0.9, 0.2).normalized(), Vec3::Constant(0.05),
                            2};
  const Vec3 n = Vec3(1, -2, 3).normalized();
  Vec3 start = Vec3::Zero();
  ContactGeometry geometry;
  ASSERT_TRUE(superquadric_point(sphere, sphere.x + 0.045 * n, start, geometry));
  EXPECT_NEAR(geometry.overlap, 0.005, 1e-15);
  EXPECT_LT((geometry.normal - n).norm(), 1e-12);
  EXPECT_LT((geometry.point - sphere.x - 0.0475 * n).norm(), 1e-14);
  EXPECT_FALSE(superquadric_point(sphere, sphere.x + 0.0501 * n, start, geometry));
}

TEST(SuperquadricPoint, FindsTheNearestSurfaceColdAndWarm) {
  Random random(4);
  for (const double m : kBlockiness) {
    int missed = 0, other_branch = 0;
    constexpr int kTried = 2000;
    for (int i = 0; i < kTried; ++i) {
      Poke poke = random_poke(random, m);
      Vec3 start = Vec3::Zero();
      for (int step = 0; step < 3; ++step) {
        ContactGeometry geometry;
        if (!superquadric_point(poke.body, poke.p, start, geometry)) {
          ASSERT_GT(step, 0) << m;
          ++missed;
          break;
        }
        EXPECT_NEAR(gap_along(poke.body, poke.p, geometry.normal), -geometry.overlap, 1e-10);
        const auto [t1, t2] = tangent_frame(geometry.normal);
        for (const Vec3& side : {t1, t2, Vec3(-t1), Vec3(-t2)})
          EXPECT_LE(gap_along(poke.body, poke.p, (geometry.normal + 1e-3 * side).normalized()),
                    -geometry.overlap + 1e-11);
        // Deeper than the least radius of curvature (corners) another branch is the right one.
        if (step == 0 && poke.overlap < 0.02 * poke.body.semi_axes.minCoeff())
          other_branch += std::fabs(geometry.overlap - poke.overlap) > 1e-10;
        poke.body.x += 1e-5 * random.on_sphere();
        poke.body.q = (poke.body.q * Quat(Eigen::AngleAxisd(2e-4, random.on_sphere()))).normalized();
      }
    }
    EXPECT_LE(missed, kTried / 10) << m;  // moved out of touch
    EXPECT_EQ(other_branch, 0) << m;
  }
}

}  // namespace
}  // namespace sluice
