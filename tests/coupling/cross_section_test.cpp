#include "coupling/cross_section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"

namespace sluice {
namespace {

// Ellipsoid: pi sqrt((b c x)^2 + (c a y)^2 + (a b z)^2), exact.
TEST(CrossSection, IsTheShadowOfAnEllipsoid) {
  const RockShape shape = make_superquadric(1.8, 0.6, 2);
  const CrossSection section(shape);
  const Vec3 a = shape.semi_axes;
  Random random(8);
  for (int i = 0; i < 100; ++i) {
    const Vec3 u = random.on_sphere();
    const double exact =
        std::numbers::pi * Vec3(a.y() * a.z() * u.x(), a.z() * a.x() * u.y(), a.x() * a.y() * u.z()).norm();
    EXPECT_NEAR(section.seen_along(u), exact, 0.01 * exact);
  }
}

// Nearly a box: the areas of its faces, each seen at its slant.
TEST(CrossSection, OfABlockTendsToThatOfItsFaces) {
  const RockShape shape = make_superquadric(1.5, 0.7, 16);
  const CrossSection section(shape);
  const Vec3 a = 2 * shape.semi_axes;
  for (const Vec3& u :
       {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0.6, 0.8, 0), Vec3(0.48, 0.6, -0.64)}) {
    const double faces =
        a.y() * a.z() * std::abs(u.x()) + a.z() * a.x() * std::abs(u.y()) + a.x() * a.y() * std::abs(u.z());
    EXPECT_NEAR(section.seen_along(u), faces, 0.1 * faces);
    EXPECT_LT(section.seen_along(u), faces);
  }
}

}  // namespace
}  // namespace sluice
