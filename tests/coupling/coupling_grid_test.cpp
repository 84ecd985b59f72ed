// What the coupling grid averages, and what it leaves out.
#include "coupling/coupling_grid.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "coupling/node_fluid.h"

namespace sluice {
namespace {

/// Water that moves unevenly in a box that is periodic along x, of a length that no level divides evenly.
struct Water {
  Domain domain;
  NodeFluid fluid{{Vec3::Zero(), Vec3(2.1, 1.5, 1.2)}, 0.05, Vec3::Zero()};

  Water() {
    domain.box = {Vec3::Zero(), Vec3(2.1, 1.5, 1.2)};
    domain.low[0] = domain.high[0] = Face::periodic;
    Random random(3);
    for (Vec3& v : fluid.nodes_.v) v = random.on_sphere();
  }
  CouplingGrid grid() const { return {domain, 0.05, 0.1, 0.8}; }
};

void add_rock(CouplingGrid& grid, int level, const Vec3& x, double volume) {
  grid.add_solids(level, grid.weights(level, x), volume);
}

/// A rock without volume at every node of every level: all water is asked for.
void ask_for_all(CouplingGrid& grid, const Box& box) {
  for (int l = grid.finest(); l <= grid.coarsest(); ++l) {
    const Vec3 step = grid.level(l).spacing;
    for (double z = 0; z <= box.hi.z() + 1e-9; z += step.z())
      for (double y = 0; y <= box.hi.y() + 1e-9; y += step.y())
        for (double x = 0; x < box.hi.x() - 1e-9; x += step.x()) add_rock(grid, l, Vec3(x, y, z), 0);
  }
}

TEST(CouplingGrid, TellsARockAsMuchOfTheWaterWhereNoOtherRockAsksForAny) {
  const Water water;
  Random random(4);
  CouplingGrid all = water.grid();
  ask_for_all(all, water.domain.box);
  all.gather(water.fluid.nodes_);
  ASSERT_LT(all.finest(), all.coarsest());
  for (int l = all.finest(); l <= all.coarsest(); ++l)
    for (int trial = 0; trial < 6; ++trial) {
      const Vec3 x(random.uniform(0, 2.1), random.uniform(0, 1.5), random.uniform(0, 1.2));
      CouplingGrid one = water.grid();
      add_rock(one, l, x, 1e-3);
      one.gather(water.fluid.nodes_);
      const LevelWeights at = one.weights(l, x);
      for (std::size_t c = 0; c < 8; ++c) {
        if (at.weight[c] <= 0) continue;
        for (int lane = fluid_lane::mass; lane <= fluid_lane::viscosity; ++lane)
          EXPECT_EQ(one.level(l).fluid_at(at.node[c])[lane], all.level(l).fluid_at(at.node[c])[lane]);
      }
      EXPECT_LE(one.level(one.finest()).wet.size(), all.level(all.finest()).wet.size());
    }
}

TEST(CouplingGrid, AveragesNoWaterWhereThereIsNoRock) {
  const Water water;
  CouplingGrid grid = water.grid();
  add_rock(grid, grid.finest(), Vec3(1.03, 0.72, 0.61), 1e-3);
  grid.gather(water.fluid.nodes_);
  EXPECT_GT(grid.level(grid.finest()).wet.size(), 7u);
  EXPECT_LT(grid.level(grid.finest()).wet.size(), 65u);
  grid.clear_solids();
  grid.gather(water.fluid.nodes_);
  for (int l = grid.finest(); l <= grid.coarsest(); ++l) EXPECT_TRUE(grid.level(l).wet.empty());
  FromRocks out;
  grid.scatter(water.fluid.nodes_, out);
  for (std::size_t i = 0; i < water.fluid.nodes_.count(); ++i) {
    EXPECT_EQ(out.impulse[i], Vec3::Zero());
    EXPECT_EQ(out.displaced[i], 0);
  }
}

TEST(CouplingGrid, PlacesARockThroughAPeriodicFaceBetweenItsNodes) {
  const Water water;
  const CouplingGrid grid = water.grid();
  Random random(5);
  for (int l = grid.finest(); l <= grid.coarsest(); ++l)
    for (int trial = 0; trial < 50; ++trial) {
      const Vec3 x(random.uniform(-2, 4), random.uniform(0, 1.5), random.uniform(0, 1.2));
      const LevelWeights at = grid.weights(l, x), same = grid.weights(l, x + Vec3(2.1, 0, 0));
      double sum = 0;
      for (std::size_t c = 0; c < 8; ++c) {
        EXPECT_GE(at.node[c], 0);
        EXPECT_LT(at.node[c], static_cast<int>(grid.level(l).fluid.size()));
        EXPECT_EQ(at.node[c], same.node[c]);
        EXPECT_NEAR(at.weight[c], same.weight[c], 1e-12);
        sum += at.weight[c];
      }
      EXPECT_NEAR(sum, 1, 1e-14);
    }
}

}  // namespace
}  // namespace sluice
