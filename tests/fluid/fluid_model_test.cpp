#include "fluid/fluid_model.h"

#include <gtest/gtest.h>

namespace sluice {
namespace {

TEST(SlurryDensity, IsTheVolumeMeanOfLiquidAndGrains) {
  FluidModel model;
  EXPECT_DOUBLE_EQ(slurry_density(model, 0.0), 1000.0);
  EXPECT_DOUBLE_EQ(slurry_density(model, 0.1), 0.9 * 1000.0 + 0.1 * 2700.0);
  EXPECT_DOUBLE_EQ(slurry_density(model, 1.0), 2700.0);
}

TEST(FinesFraction, IsReadBackFromTheDensity) {
  const FluidModel model;
  for (const double phi : {0.0, 0.013, 0.2, 0.5})
    EXPECT_NEAR(fines_fraction(model, slurry_density(model, phi)), phi, 1e-14);
  EXPECT_EQ(fines_fraction(model, 990), 0);
  EXPECT_EQ(fines_fraction(model, 2700), 0.95 * model.packing);
}

// Krieger & Dougherty (1959): (1 - 0.3/0.6)^(-1.5) = 2^1.5.
TEST(SlurryViscosity, FollowsKriegerAndDougherty) {
  FluidModel model;
  EXPECT_DOUBLE_EQ(slurry_viscosity(model, 0.0), 1e-3);
  EXPECT_NEAR(slurry_viscosity(model, 0.3), 1e-3 * 2.8284271247461903, 1e-15);
}

// Einstein (1906): 1 + 2.5 phi for dilute suspensions.
TEST(SlurryViscosity, HasEinsteinsSlopeWhenDilute) {
  FluidModel model;
  const double phi = 1e-6;
  EXPECT_NEAR((slurry_viscosity(model, phi) / model.viscosity - 1.0) / phi, 2.5, 1e-4);
}

TEST(Pressure, IsZeroAtRestVolumeAndRhoCSquaredTimesStrain) {
  EXPECT_EQ(pressure_of(1000, 20, 1.0), 0.0);
  EXPECT_NEAR(pressure_of(1000, 20, 1.0 - 1e-6), 1000 * 400 * 1e-6, 1e-6);
  EXPECT_LT(pressure_of(1000, 20, 1.01), 0.0);
}

}  // namespace
}  // namespace sluice
