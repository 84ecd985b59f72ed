#include "geometry/wall.h"

#include <gtest/gtest.h>

#include <utility>

namespace sluice {
namespace {

Walls two_walls() {
  Wall floor, tank;
  floor.name = "floor";
  floor.mesh = make_rectangle("floor", {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)});
  floor.surface_velocity = Vec3(2, 0, 0);
  tank.name = "tank";
  tank.mesh = make_box("tank", {Vec3(0, 0, 1), Vec3(1, 1, 2)});
  return Walls({floor, tank});
}

TEST(Walls, KnowWhichWallATriangleBelongsTo) {
  const Walls walls = two_walls();
  ASSERT_EQ(walls.mesh().triangles.size(), 14u);
  EXPECT_EQ(walls.wall_of(1), 0);
  EXPECT_EQ(walls.wall_of(2), 1);
  EXPECT_EQ(walls.wall_of(13), 1);
  EXPECT_EQ(walls.surface_velocity(0, Vec3::Zero()), Vec3(2, 0, 0));
  const auto hit = walls.query().first_hit(Vec3(0.4, 0.5, 3), Vec3(0.4, 0.5, -1));
  ASSERT_TRUE(hit);
  EXPECT_EQ(walls.wall_of(hit->triangle), 1);
  EXPECT_DOUBLE_EQ(hit->point.z(), 2);
}

TEST(Walls, AnswerAfterTheyWereMoved) {
  Walls first = two_walls();
  Walls walls;
  EXPECT_TRUE(walls.empty());
  walls = std::move(first);
  EXPECT_FALSE(walls.empty());
  EXPECT_DOUBLE_EQ(walls.query().nearest(Vec3(0.5, 0.5, 0.25), 1)->distance, 0.25);
}

}  // namespace
}  // namespace sluice
