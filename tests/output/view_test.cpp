#include "output/view.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "output/base64.h"
#include "output/run_folder.h"
#include "output/temporary_folder.h"

namespace sluice {
namespace {

Snapshot much_water(std::size_t n) {
  Snapshot s;
  s.time = 1.5;
  s.water_point_volume = 1e-6;
  WaterPoints& w = s.water.emplace();
  for (std::size_t i = 0; i < n; ++i) {
    w.id.push_back(i);
    w.x.emplace_back(static_cast<double>(i), 0, 0);
    w.v.emplace_back(0, 3, 4);
  }
  return s;
}

TEST(View, ShowsNoMoreWaterThanAsked) {
  const View all = make_view(much_water(100), {}, 100);
  EXPECT_EQ(all.water->count(), 100u);
  EXPECT_EQ(all.water->stride, 1u);
  const View some = make_view(much_water(101), {}, 50);
  EXPECT_EQ(some.water->stride, 3u);
  EXPECT_EQ(some.water->count(), 34u);
  EXPECT_EQ(some.water->total, 101u);
  EXPECT_EQ(some.water->x[3], 3.0F);
  EXPECT_EQ(some.water->speed[0], 5.0F);
  // a shown point stands for three
  EXPECT_NEAR(std::pow(some.water->point_radius / all.water->point_radius, 3), 3, 1e-12);
}

TEST(View, ReadsBackWhatItWrote) {
  const TemporaryFolder temporary;
  Snapshot s = much_water(5);
  RockSnapshot& r = s.rocks.emplace();
  r.id = {1};
  r.x = {Vec3(1, 2, 3)};
  r.v = {Vec3(0, 0, -2)};
  r.q = {Quat(0.5, 0.5, 0.5, 0.5)};
  r.semi_axes = {Vec3(0.1, 0.05, 0.025)};
  r.blockiness = {4};
  r.wetted = {0.5};
  std::vector<Wall> walls(1);
  walls[0].name = "ledge \"1\"";
  walls[0].mesh = make_box("ledge", {Vec3(0, 0, 0), Vec3(1, 2, 3)});
  s.walls = &walls;
  const View view = make_view(s, {{"lip", "exit", Vec3(0, 0, 0), Vec3(1, 0, 1)}});
  write_view(temporary.path / "view.json", view);
  const View back = read_view(temporary.path / "view.json");
  EXPECT_EQ(view_text(back), view_text(view));
  EXPECT_EQ(back.walls[0].name, "ledge \"1\"");
  EXPECT_EQ(back.walls[0].vertices, view.walls[0].vertices);
  EXPECT_EQ(back.walls[0].triangles, view.walls[0].triangles);
  EXPECT_EQ(back.rocks->q, view.rocks->q);
  EXPECT_EQ(back.rocks->speed, std::vector<float>{2});
  EXPECT_EQ(back.water->x, view.water->x);
  EXPECT_EQ(back.marks[0].kind, "exit");
}

TEST(View, KeepsAbsentPhasesAbsent) {
  const TemporaryFolder temporary;
  write_view(temporary.path / "view.json", make_view(Snapshot{}));
  const View back = read_view(temporary.path / "view.json");
  EXPECT_FALSE(back.rocks);
  EXPECT_FALSE(back.water);
}

TEST(View, RefusesADamagedFile) {
  const TemporaryFolder temporary;
  const auto file = temporary.path / "view.json";
  const std::string whole = view_text(make_view(much_water(5)));
  write_atomically(file, whole.substr(0, whole.size() / 2));
  EXPECT_THROW(read_view(file), InputError);
  std::string fewer = whole;
  fewer.replace(fewer.find("\"count\":5"), 9, "\"count\":6");
  write_atomically(file, fewer);
  EXPECT_THROW(read_view(file), InputError);
}

TEST(Base64, AgreesWithItsStandard) {
  // RFC 4648, section 10
  const std::vector<std::pair<std::string, std::string>> known = {{"", ""},
                                                                  {"f", "Zg=="},
                                                                  {"fo", "Zm8="},
                                                                  {"foo", "Zm9v"},
                                                                  {"foob", "Zm9vYg=="},
                                                                  {"fooba", "Zm9vYmE="},
                                                                  {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, coded] : known) {
    EXPECT_EQ(base64(plain.data(), plain.size()), coded);
    const auto back = from_base64(coded);
    ASSERT_TRUE(back);
    EXPECT_EQ(std::string(back->begin(), back->end()), plain);
  }
  EXPECT_FALSE(from_base64("abc"));
  EXPECT_FALSE(from_base64("ab!c"));
}

TEST(View, ShowsAMovingWallWhereItIs) {
  std::vector<Wall> walls(1);
  walls[0].mesh = make_box("plate", {Vec3(0, 0, 0), Vec3(1, 2, 3)});
  walls[0].motion.emplace();
  walls[0].motion->kind = MotionKind::keyframes;
  walls[0].motion->keyframes = {{0, Vec3(0, 0, 0), Vec3(0, 0, 0)}, {1, Vec3(0, 0, 5), Vec3(0, 0, 0)}};
  Snapshot s;
  s.time = 1.5;
  s.walls = &walls;
  const View view = make_view(s);
  for (std::size_t v = 0; v < walls[0].mesh.vertices.size(); ++v)
    EXPECT_EQ(view.walls[0].vertices[3 * v + 2], static_cast<float>(walls[0].mesh.vertices[v].z() + 5));
}

}  // namespace
}  // namespace sluice
