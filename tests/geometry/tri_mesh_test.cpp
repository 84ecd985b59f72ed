#include "geometry/tri_mesh.h"

#include <gtest/gtest.h>

#include "geometry/shapes.h"

namespace sluice {
namespace {

TEST(TriMesh, BoxIsClosedOutwardAndHasItsVolume) {
  const TriMesh box = make_box("tank", {Vec3(-1, 2, 0), Vec3(1, 5, 0.5)});
  EXPECT_DOUBLE_EQ(volume_of(box), 3.0);
  double area = 0;
  Vec3 sum = Vec3::Zero();
  for (int t = 0; t < 12; ++t) {
    area += box.area(t);
    sum += box.area(t) * box.normal(t);
  }
  EXPECT_DOUBLE_EQ(area, 2 * (2 * 3 + 2 * 0.5 + 3 * 0.5));
  EXPECT_NEAR(sum.norm(), 0, 1e-15);
  EXPECT_EQ(box.bounds().lo, Vec3(-1, 2, 0));
  EXPECT_EQ(box.bounds().hi, Vec3(1, 5, 0.5));
}

TEST(TriMesh, DegenerateTriangleHasZeroNormalAndArea) {
  TriMesh mesh = make_rectangle("line", {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(0, 1, 0)});
  EXPECT_EQ(mesh.normal(0), Vec3::Zero().eval());
  EXPECT_EQ(mesh.area(0), 0);
  EXPECT_EQ(mesh.normal(1), Vec3(0, 0, 1));
}

TEST(TriMesh, AppendKeepsPartsApartAndJoinsEqualNames) {
  TriMesh mesh = make_box("a", {Vec3::Zero(), Vec3::Ones()});
  mesh.append(make_rectangle("b", {Vec3(0, 0, 2), Vec3(1, 0, 2), Vec3(1, 1, 2), Vec3(0, 1, 2)}));
  mesh.append(make_rectangle("a", {Vec3(0, 0, 3), Vec3(1, 0, 3), Vec3(1, 1, 3), Vec3(0, 1, 3)}));
  ASSERT_EQ(mesh.triangles.size(), 16u);
  EXPECT_EQ(mesh.part_names, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(mesh.part[11], 0);
  EXPECT_EQ(mesh.part[12], 1);
  EXPECT_EQ(mesh.part[15], 0);
  EXPECT_EQ(mesh.vertices[static_cast<std::size_t>(mesh.triangles[15][2])], Vec3(0, 1, 3));
}

}  // namespace
}  // namespace sluice
