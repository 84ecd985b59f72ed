#include "geometry/triangulate_polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "geometry/tri_mesh.h"

namespace sluice {
namespace {

/// Sum of the triangles' areas, each counted with its sign along the normal; and all must count alike.
double area_along(const Vec3& normal, const std::vector<Vec3>& vertices) {
  std::vector<int> corners(vertices.size());
  std::iota(corners.begin(), corners.end(), 0);
  const auto cut = triangulate_polygon(vertices, corners);
  if (!cut || cut->size() != vertices.size() - 2) return -1;
  double sum = 0;
  for (const auto& [a, b, c] : *cut) {
    const auto x = [&](int v) { return vertices[static_cast<std::size_t>(v)]; };
    const double area = 0.5 * (x(b) - x(a)).cross(x(c) - x(a)).dot(normal);
    if (area <= 0) return -2;
    sum += area;
  }
  return sum;
}

TEST(TriangulatePolygon, CoversAnLAndNotItsNotch) {
  const std::vector<Vec3> l{{0, 0, 5}, {2, 0, 5}, {2, 1, 5}, {1, 1, 5}, {1, 2, 5}, {0, 2, 5}};
  EXPECT_DOUBLE_EQ(area_along(Vec3(0, 0, 1), l), 3);
  EXPECT_DOUBLE_EQ(area_along(Vec3(0, 0, -1), {l.rbegin(), l.rend()}), 3);
}

TEST(TriangulatePolygon, UsesCornersThatLieOnAStraightEdge) {
  EXPECT_DOUBLE_EQ(
      area_along(Vec3(0, 1, 0), {{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {1, 0, 2}, {2, 0, 2}, {2, 0, 0}}), 4);
}

TEST(TriangulatePolygon, CoversAStarInATiltedPlane) {
  const Vec3 normal = Vec3(1, 2, 3).normalized();
  const auto [e1, e2] = tangent_frame(normal);
  std::vector<Vec3> star;
  constexpr int points = 11;
  for (int k = 0; k < 2 * points; ++k) {
    const double radius = k % 2 == 0 ? 1.0 : 0.3, angle = std::numbers::pi * k / points;
    star.push_back(Vec3(7, 8, 9) + radius * (std::cos(angle) * e1 + std::sin(angle) * e2));
  }
  EXPECT_NEAR(area_along(normal, star), points * 0.3 * std::sin(std::numbers::pi / points), 1e-13);
}

TEST(TriangulatePolygon, RefusesAPolygonWithoutArea) {
  EXPECT_FALSE(triangulate_polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {0, 1, 2, 3}));
  EXPECT_FALSE(triangulate_polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {0, 1, 0, 1}));
}

}  // namespace
}  // namespace sluice
