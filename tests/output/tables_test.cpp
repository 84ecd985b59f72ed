#include "output/tables.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sluice {
namespace {

TEST(Tables, NameEveryColumnOnceAndFillEveryCell) {
  ExitBinRow exit;
  exit.exit = "lip";
  MixingTableRow mixing;
  mixing.zone = "top";
  WallRow wall;
  wall.wall = "ledge";
  for (const CsvTable& table : {exit_table({exit}), mixing_table({mixing}), wall_table({wall})}) {
    ASSERT_EQ(table.rows.size(), 1u);
    EXPECT_EQ(table.rows[0].size(), table.columns.size());
    for (std::size_t k = 0; k < table.columns.size(); ++k) EXPECT_EQ(table.find(table.columns[k]), k);
  }
}

TEST(Tables, PutValuesUnderTheirNames) {
  ExitBinRow exit;
  exit.exit = "lip";
  exit.bin = 3;
  exit.rock_kg_s = {10, 9, 11};
  exit.rock_residence_s = {4.5, 4, 5};
  const CsvTable table = exit_table({exit});
  EXPECT_EQ(table.numbers("bin"), std::vector<double>{3});
  EXPECT_EQ(table.numbers("rock_kg_s_high95"), std::vector<double>{11});
  EXPECT_EQ(table.numbers("rock_residence_s"), std::vector<double>{4.5});
  EXPECT_EQ(table.numbers("rock_residence_s_low95"), std::vector<double>{4});
  EXPECT_TRUE(std::isnan(table.numbers("water_kg_s")[0]));
}

TEST(Tables, GiveWallsTheirMeanForce) {
  WallRow wall;
  wall.wall = "ledge";
  wall.time_s = 2;
  wall.rock.impulse = Vec3(0, 0, -10);
  wall.water.sliding_energy = 7;
  const CsvTable table = wall_table({wall});
  EXPECT_EQ(table.numbers("rock_mean_force_z_N"), std::vector<double>{-5});
  EXPECT_EQ(table.numbers("rock_impulse_z_N_s"), std::vector<double>{-10});
  EXPECT_EQ(table.numbers("water_sliding_energy_J"), std::vector<double>{7});
}

}  // namespace
}  // namespace sluice
