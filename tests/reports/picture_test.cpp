#include "reports/picture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sluice {
namespace {

const PictureSize small{80, 60, 2};

/// A ball of 0.2 m radius at the origin inside a box of 1 m.
View ball_in_box() {
  View view;
  ViewRocks& r = view.rocks.emplace();
  r.x = {0, 0, 0};
  r.q = {1, 0, 0, 0};
  r.semi_axes = {0.2F, 0.2F, 0.2F};
  r.blockiness = {2};
  r.speed = {1};
  r.wetted = {0};
  const TriMesh box = make_box("box", {Vec3::Constant(-0.5), Vec3::Constant(0.5)});
  ViewWall& wall = view.walls.emplace_back();
  wall.name = "box";
  for (const Vec3& x : box.vertices)
    for (int k = 0; k < 3; ++k) wall.vertices.push_back(static_cast<float>(x[k]));
  for (const auto& t : box.triangles)
    for (const int i : t) wall.triangles.push_back(static_cast<std::uint32_t>(i));
  return view;
}

std::array<int, 3> pixel(const Image& image, int x, int y) {
  const std::size_t at = 3 * static_cast<std::size_t>(y * image.width + x);
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

TEST(Png, GivesBackTheImage) {
  Image image{3, 2, {}};
  for (int k = 0; k < 18; ++k) image.rgb.push_back(static_cast<std::uint8_t>(13 * k));
  const Image back = read_png(png_bytes(image));
  EXPECT_EQ(back.width, 3);
  EXPECT_EQ(back.height, 2);
  EXPECT_EQ(back.rgb, image.rgb);
  EXPECT_ANY_THROW(read_png("no picture"));
}

TEST(Picture, ShowsTheRockThroughTheWalls) {
  View view = ball_in_box();
  const Camera camera = side_camera(scene_frame(view), small);
  const Image with = draw_picture(view, camera, {2}, small);
  view.rocks.reset();
  const Image without = draw_picture(view, camera, {2}, small);
  EXPECT_NE(pixel(with, 40, 30), pixel(without, 40, 30));
  EXPECT_EQ(pixel(with, 2, 2), pixel(without, 2, 2));
}

TEST(Picture, IsToScaleFromTheSide) {
  View view = ball_in_box();
  const Camera camera = side_camera(scene_frame(view), small);
  const Image with = draw_picture(view, camera, {2}, small);
  view.rocks.reset();
  const Image without = draw_picture(view, camera, {2}, small);
  int wide = 0;
  for (int x = 0; x < small.width; ++x)
    if (pixel(with, x, 30) != pixel(without, x, 30)) ++wide;
  // 0.4 m of camera.view_height over 60 pixels; darkening near the rim may add a pixel a side
  EXPECT_NEAR(wide, 0.4 / camera.view_height * small.height, 2.5);
}

TEST(Picture, HidesWhatLiesBehindARock) {
  View view = ball_in_box();
  view.walls.clear();
  const Camera camera = side_camera(scene_frame(ball_in_box()), small);
  const Image alone = draw_picture(view, camera, {2}, small);
  ViewWater& water = view.water.emplace();
  const Vec3 behind = 0.4 * (camera.target - camera.eye).normalized();
  for (int k = 0; k < 3; ++k) water.x.push_back(static_cast<float>(behind[k]));
  water.speed = {1};
  water.point_radius = 0.05;
  view.rocks->speed = {0};
  const Image with_water = draw_picture(view, camera, {2}, small);
  View dry = view;
  dry.water->x = {0, 0, 100};
  EXPECT_EQ(pixel(with_water, 40, 30), pixel(draw_picture(dry, camera, {2}, small), 40, 30));
  EXPECT_EQ(alone.rgb.size(), with_water.rgb.size());
}

TEST(Picture, IsTheSameEveryTime) {
  const View view = ball_in_box();
  const Camera camera = overview_camera(scene_frame(view), small);
  EXPECT_EQ(draw_picture(view, camera, {2}, small).rgb, draw_picture(view, camera, {2}, small).rgb);
}

TEST(Picture, StandsWithoutAnythingToShow) {
  const View view;
  const Image image = draw_picture(view, overview_camera(scene_frame(view), small), speed_scale(view), small);
  EXPECT_EQ(image.rgb.size(), 80u * 60u * 3u);
}

TEST(SpeedScale, EndsAtARoundSpeedAboveNearlyAll) {
  View view;
  ViewWater& water = view.water.emplace();
  for (int k = 0; k < 1000; ++k) water.speed.push_back(k < 995 ? 2.7F : 90.0F);
  EXPECT_EQ(speed_scale(view).fastest, 3.0);
}

TEST(SceneFrame, TakesTheWidthFromTheExit) {
  View view = ball_in_box();
  view.marks = {{"lip", "exit", Vec3(-0.4, 0.5, 0), Vec3(0.4, 0.5, 0.2)}};
  const SceneFrame frame = scene_frame(view);
  EXPECT_EQ(frame.along, Vec3(0, 1, 0));
  EXPECT_NEAR(std::abs(frame.across.x()), 1, 1e-15);
}

}  // namespace
}  // namespace sluice
