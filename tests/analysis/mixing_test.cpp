#include "analysis/mixing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/memory_archive.h"
#include "base/random.h"
#include "inflow/belt_scene.h"
#include "inflow/fake_fluid.h"
#include "inflow/map_schema.h"

namespace sluice {
namespace {

TEST(MixIndices, GiveTheWorkedNumbers) {
  // analysis_mixing_worked.json: Lacey (1954), Danckwerts (1952), relative standard deviation.
  const MixIndices m = mix_indices({{12, 8}, {9, 11}, {15, 5}, {10, 10}, {4, 16}, {10, 10}}, 1, 1);
  EXPECT_DOUBLE_EQ(m.share, 0.5);
  EXPECT_NEAR(m.variance, 0.033, 1e-12);
  EXPECT_NEAR(m.lacey, 0.9136842105263159, 1e-12);
  EXPECT_NEAR(m.rsd, 0.36331804249169897, 1e-12);
  EXPECT_NEAR(m.segregation, 0.132, 1e-12);
}

TEST(MixIndices, AreOneForARandomMixOfUnequalGrains) {
  // Grains of 1 and 0.2: Poole, Taylor & Wall (1964) give the random limit.
  Random random(2);
  double lacey = 0;
  for (int run = 0; run < 100; ++run) {
    std::vector<MixCell> cells(50);
    for (int i = 0; i < 1000; ++i) cells[static_cast<std::size_t>(random.uniform(0, 50))].a += 1;
    for (int i = 0; i < 5000; ++i) cells[static_cast<std::size_t>(random.uniform(0, 50))].b += 0.2;
    lacey += mix_indices(cells, 1, 0.2).lacey / 100;
  }
  EXPECT_NEAR(lacey, 1, 0.005);
}

TEST(MixIndices, OfEvenCellsHaveNoSegregation) {
  const MixIndices m = mix_indices({{1, 3}, {2, 6}, {0, 0}, {5, 15}}, 0.01, 0.01);
  EXPECT_NEAR(m.segregation, 0, 1e-15);
  EXPECT_GE(m.lacey, 1);
}

TEST(MixIndices, HaveNoLaceyIndexWhereCellsHoldAGrainOrTwo) {
  // p = 1/2: s0^2 = 1/4; grains of 1 in cells of content 2 give sR^2 = 1/8, of content 2.5 give 1/10.
  const MixIndices few = mix_indices({{2, 0}, {1, 1}, {0, 2}}, 1, 1);
  EXPECT_TRUE(std::isnan(few.lacey));
  EXPECT_TRUE(std::isfinite(few.segregation));
  EXPECT_TRUE(std::isfinite(few.rsd));
  EXPECT_TRUE(std::isfinite(mix_indices({{2.5, 0}, {1.25, 1.25}, {0, 2.5}}, 1, 1).lacey));
}

TEST(MixIndices, AreUnknownWithoutBothComponents) {
  EXPECT_TRUE(std::isnan(mix_indices({{1, 0}, {2, 0}}, 1, 1).lacey));
  EXPECT_TRUE(std::isnan(mix_indices({{1, 1}}, 1, 1).rsd));
  EXPECT_TRUE(std::isnan(mix_indices({}, 1, 1).share));
}

MixingConfig box() {
  MixingConfig c;
  c.name = "box";
  c.low = Vec3(0, 0, 0);
  c.high = Vec3(1, 1, 1);
  c.slabs = 2;
  c.cell = 0.25;
  return c;
}

TEST(MixingProbe, WritesARowPerSlab) {
  test::FakeFluid fluid(0.1);
  test::BeltScene scene(0.05, 0.05, 0);
  // Lower half: rock and water side by side. Upper half: water alone.
  fluid.add({.x = Vec3(0.1, 0.1, 0.1), .mass = 1});
  fluid.add({.x = Vec3(0.1, 0.1, 0.9), .mass = 2});
  fluid.add({.x = Vec3(0.1, 0.1, 1.9), .mass = 50});
  scene.rocks->add({.x = Vec3(0.9, 0.1, 0.1), .material = 1, .size = 0.05});
  scene.rocks->add_wet_dose(std::vector<double>{0.25}, 0.1);
  MixingProbe probe(box());
  probe.look({.t = 3, .dt = 0.1, .rocks = scene.rocks.get(), .water = &fluid});
  ASSERT_EQ(probe.rows().size(), 2u);
  const MixingRow &low = probe.rows()[0], &high = probe.rows()[1];
  EXPECT_EQ(low.t, 3);
  EXPECT_DOUBLE_EQ(low.position, 0.25);
  EXPECT_DOUBLE_EQ(high.position, 0.75);
  EXPECT_DOUBLE_EQ(low.water_kg, 1);
  EXPECT_DOUBLE_EQ(high.water_kg, 2);
  EXPECT_DOUBLE_EQ(low.rock_kg, scene.rocks->rocks().mass[0]);
  EXPECT_DOUBLE_EQ(low.wetted, 0.25);
  EXPECT_EQ(low.met_water, 1);
  EXPECT_TRUE(std::isnan(high.lacey));
  EXPECT_TRUE(std::isnan(high.wetted));
  // Two cells that each hold one component only: apart.
  EXPECT_GE(low.segregation, 1);
  EXPECT_EQ(probe.columns().size(), probe.values().size());
}

TEST(MixingProbe, KeepsItsRowsOverARestart) {
  test::FakeFluid fluid(0.1);
  fluid.add({.x = Vec3(0.1, 0.1, 0.1), .mass = 1});
  MixingProbe probe(box()), again(box());
  probe.look({.t = 3, .water = &fluid});
  MemoryArchive archive;
  probe.exchange(archive);
  archive.rewind_to_load();
  again.exchange(archive);
  ASSERT_EQ(again.rows().size(), 2u);
  EXPECT_EQ(again.rows()[0].water_kg, 1);
}

TEST(MixingKeys, RefuseABoxWithoutVolume) {
  test::MapSchema s;
  s.vectors = {{"low", Vec3(0, 0, 0)}, {"high", Vec3(1, 1, 0)}};
  MixingConfig c;
  c.keys(s);
  EXPECT_TRUE(s.complains_about("high"));
  EXPECT_TRUE(s.complains_about("cell"));
}

}  // namespace
}  // namespace sluice
