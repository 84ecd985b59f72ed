#include "analysis/wear.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sluice {
namespace {

// Numbers: analysis_wear_worked.json (Archard 1953; Finnie 1960; Zhao et al. 2017).

TEST(Wear, ArchardGivesTheWorkedVolume) {
  EXPECT_NEAR(archard_volume(1e-3, 50, 1000, 2e9), 2.5e-8, 1e-20);
}

TEST(Wear, ArchardFromWorkAgreesWithForceTimesDistance) {
  EXPECT_NEAR(archard_volume_from_work(1e-3, 0.3 * 50 * 1000, 0.3, 2e9), archard_volume(1e-3, 50, 1000, 2e9),
              1e-20);
}

TEST(Wear, FinnieGivesTheWorkedAngleFunction) {
  const double degree = std::numbers::pi / 180;
  EXPECT_NEAR(finnie_angle_function(5 * degree), 0.15085980718524242, 1e-12);
  EXPECT_NEAR(finnie_angle_function(15 * degree), 0.29903810567665795, 1e-12);
  EXPECT_NEAR(finnie_angle_function(30 * degree), 0.25, 1e-12);
  EXPECT_NEAR(finnie_angle_function(60 * degree), 0.08333333333333337, 1e-12);
  EXPECT_NEAR(finnie_angle_function(90 * degree), 0, 1e-12);
}

TEST(Wear, FinnieIsContinuousWhereItsTwoLawsMeet) {
  const double angle = std::atan(2.0 / 6);
  EXPECT_NEAR(finnie_angle_function(angle - 1e-9), finnie_angle_function(angle + 1e-9), 1e-8);
}

TEST(Wear, ShearImpactVolumeIsWorkOverPressure) {
  EXPECT_DOUBLE_EQ(shear_impact_volume(1.17, 1e9), 1.17e-9);
}

TEST(Wear, IntensityIsPerAreaAndTime) {
  WallLoad load;
  load.sliding_energy = 30;
  load.impact_energy = 12;
  load.impulse = Vec3(0, 3, 4);
  const WearIntensity w = wear_intensity(load, 2, 3);
  EXPECT_DOUBLE_EQ(w.sliding, 5);
  EXPECT_DOUBLE_EQ(w.impact, 2);
  EXPECT_DOUBLE_EQ(w.pressure, 5.0 / 6);
  EXPECT_EQ(wear_intensity(load, 0, 3).sliding, 0);
}

}  // namespace
}  // namespace sluice
