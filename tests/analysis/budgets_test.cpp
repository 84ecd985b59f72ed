#include "analysis/budgets.h"

#include <gtest/gtest.h>

#include "inflow/fake_fluid.h"

namespace sluice {
namespace {

TEST(PhaseBudget, LosesNothingWhenAllIsCounted) {
  PhaseBudget b;
  b.initial = 3;
  b.entered = 10;
  b.inside = 8;
  b.left = {{"lip", 4}, {"outside", 1}};
  EXPECT_EQ(b.left_sum(), 5);
  EXPECT_EQ(b.lost(), 0);
  b.inside = 7;
  EXPECT_EQ(b.lost(), 1);
}

TEST(MassBudgets, CloseForWaterAndFines) {
  test::FakeFluid fluid(0.1);
  for (int i = 0; i < 10; ++i)
    fluid.add({.x = Vec3(0.1 * i, 0, 0.5), .v = Vec3(1, 0, 0), .mass = 0.3, .fines_mass = 0.1});
  ExitConfig c;
  c.name = "lip";
  c.low = Vec3(1, -1, 0);
  c.high = Vec3(1, 1, 1);
  Exits exits({c}, Walls{}, 0.1);
  const double before = fluid.total_mass(), fines = fluid.total_fines();
  fluid.drift(0.35);
  exits.collect(0.35, nullptr, &fluid);
  MassBudgets b = mass_budgets(exits, nullptr, &fluid);
  b.water.initial = before;
  b.fines.initial = fines;
  ASSERT_EQ(b.water.left.size(), 2u);
  EXPECT_EQ(b.water.left[0].exit, "lip");
  EXPECT_GT(b.water.left[0].kg, 0.8);
  EXPECT_NEAR(b.water.lost(), 0, 1e-12 * before);
  EXPECT_NEAR(b.fines.lost(), 0, 1e-12 * before);
  EXPECT_EQ(b.rock.inside, 0);
}

TEST(MomentumResidual, IsZeroWhenEveryTermIsThere) {
  MomentumTerms m;
  m.at_start = Vec3(1, 0, 0);
  m.gravity = Vec3(0, 0, -9);
  m.entered = Vec3(4, 0, 0);
  m.left = Vec3(2, 0, -1);
  m.to_walls = Vec3(0, 0, -5);
  m.from_other = Vec3(0.5, 0, 0);
  m.now = Vec3(3.5, 0, -3);
  EXPECT_LT(momentum_residual(m).norm(), 1e-15);
  m.now.x() += 1;
  EXPECT_NEAR(momentum_residual(m).x(), 1, 1e-15);
}

TEST(ImpulseToWalls, SumsTheWalls) {
  std::vector<WallLoad> loads(2);
  loads[0].impulse = Vec3(1, 2, 3);
  loads[1].impulse = Vec3(1, 0, -3);
  EXPECT_EQ(impulse_to_walls(loads), Vec3(2, 2, 0));
}

}  // namespace
}  // namespace sluice
