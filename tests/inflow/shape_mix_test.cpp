#include "inflow/shape_mix.h"

#include <gtest/gtest.h>

#include <map>

#include "inflow/map_schema.h"

namespace sluice {
namespace {

ShapeMixConfig two_families() {
  ShapeMixConfig c;
  c.classes.push_back({.kind = ShapeKind::sphere, .share = 1});
  c.classes.push_back({.kind = ShapeKind::superquadric,
                       .share = 3,
                       .elongation_low = 1,
                       .elongation_high = 2,
                       .flatness_low = 0.5,
                       .flatness_high = 1,
                       .blockiness = {2, 4}});
  return c;
}

TEST(ShapeMix, IsSpheresUnlessSaidOtherwise) {
  std::vector<RockShape> table;
  const ShapeMix mix = make_shape_mix({}, table);
  ASSERT_EQ(table.size(), 1u);
  EXPECT_TRUE(table[0].is_sphere());
  Random random(1);
  EXPECT_EQ(mix.draw(random), 0);
  EXPECT_DOUBLE_EQ(mix.mean_volume(), table[0].volume);
}

TEST(ShapeMix, QuantisesEachRange) {
  std::vector<RockShape> table;
  const ShapeMix mix = make_shape_mix(two_families(), table);
  EXPECT_EQ(table.size(), 1u + 3 * 3 * 2);
  EXPECT_EQ(mix.count(), table.size());
}

TEST(ShapeMix, AppendsToTheTableOfTheScene) {
  std::vector<RockShape> table(5);
  const ShapeMix mix = make_shape_mix({}, table);
  Random random(1);
  EXPECT_EQ(mix.draw(random), 5);
}

TEST(ShapeMix, MatchesItsSharesByMass) {
  std::vector<RockShape> table;
  const ShapeMix mix = make_shape_mix(two_families(), table);
  Random random(3);
  double spheres = 0, all = 0;
  const int n = 100000;
  for (int i = 0; i < n; ++i) {
    const int shape = mix.draw(random);
    const double volume = table[static_cast<std::size_t>(shape)].volume;
    all += volume;
    if (shape == 0) spheres += volume;
  }
  EXPECT_NEAR(spheres / all, 0.25, 0.01);
  EXPECT_NEAR(all / n, mix.mean_volume(), 0.01 * mix.mean_volume());
}

TEST(ShapeMixKeys, RefuseARangeThatGoesDownwards) {
  test::MapSchema s;
  s.numbers_given = {{"elongation_low", 2}, {"elongation_high", 1.5}};
  ShapeClass c;
  c.keys(s);
  EXPECT_TRUE(s.complains_about("elongation_low"));
}

TEST(ShapeMixKeys, RefuseAxesForSpheres) {
  test::MapSchema s;
  s.words["kind"] = "sphere";
  s.numbers_given = {{"elongation_low", 2}};
  ShapeClass c;
  c.keys(s);
  EXPECT_TRUE(s.complains_about("elongation_low"));
}

}  // namespace
}  // namespace sluice
