#include "fluid/fluid_model.h"

#include <gtest/gtest.h>

#include <cmath>

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

FluidModel yielding(Rheology rheology, double flow_index = 1) {
  FluidModel model;
  model.rheology = rheology;
  model.viscosity = 0.4;
  model.yield_stress = 12;
  model.flow_index = flow_index;
  return model;
}

TEST(ApparentViscosity, IsOfBinghamsStressFarAboveTheYieldRate) {
  const FluidModel model = yielding(Rheology::bingham);
  for (const double rate : {10.0, 100.0})
    EXPECT_NEAR(apparent_viscosity(model, flow_curve(model, 0), rate) * rate, 12 + 0.4 * rate, 1e-12 * rate);
}

TEST(ApparentViscosity, IsOfHerschelBulkleysStressFarAboveTheYieldRate) {
  const FluidModel model = yielding(Rheology::herschel_bulkley, 0.5);
  for (const double rate : {10.0, 100.0}) {
    const double stress = 12 + 0.4 * std::sqrt(rate);
    EXPECT_NEAR(apparent_viscosity(model, flow_curve(model, 0), rate) * rate, stress, 2e-4 * stress);
  }
}

TEST(ApparentViscosity, FallsWithTheRateFromTheLargestOne) {
  for (const double index : {1.0, 0.4}) {
    const FluidModel model = yielding(Rheology::herschel_bulkley, index);
    const FlowCurve curve = flow_curve(model, 0);
    double last = largest_viscosity(model, 0);
    EXPECT_DOUBLE_EQ(last, 12 / 0.1 + 0.4 * std::pow(0.1, index - 1));
    EXPECT_NEAR(apparent_viscosity(model, curve, 1e-12), last, 1e-9 * last);
    for (double rate = 1e-6; rate < 1e4; rate *= 1.3) {
      const double now = apparent_viscosity(model, curve, rate);
      EXPECT_LE(now, last * (1 + 1e-12)) << rate;
      last = now;
    }
  }
}

TEST(ApparentViscosity, WithoutYieldStressAndWithIndexOneIsTheViscosity) {
  FluidModel model = yielding(Rheology::herschel_bulkley);
  model.yield_stress = 0;
  for (const double phi : {0.0, 0.2})
    for (const double rate : {0.0, 1e-3, 1.0, 1e3})
      EXPECT_NEAR(apparent_viscosity(model, flow_curve(model, phi), rate), slurry_viscosity(model, phi),
                  1e-12);
}

// Chateau, Ovarlez & Trung (2008): tau_y(phi) = tau_y sqrt((1 - phi) g), with g = 2^1.5 at phi = 0.3, packing
// 0.6.
TEST(FlowCurve, OfASlurryIsThatOfGrainsInAYieldStressFluid) {
  const FluidModel model = yielding(Rheology::herschel_bulkley, 0.5);
  const FlowCurve curve = flow_curve(model, 0.3);
  EXPECT_NEAR(curve.yield_stress, 12 * std::sqrt(0.7 * std::pow(2, 1.5)), 1e-12);
  EXPECT_NEAR(curve.consistency, 0.4 * std::pow(2, 1.5 * 0.75) * std::pow(0.7, 0.25), 1e-12);
}

// Atapattu, Chhabra & Uhlherr (1995): Re over 1 + (7 pi / 24) Bi, Bi = tau_y d / (K U).
TEST(ViscosityAround, AddsTheYieldStressAsAtapattuDid) {
  const FluidModel model = yielding(Rheology::bingham);
  const double d = 0.01, speed = 100 * d;
  const double drag = 3 * 3.14159265358979 * d * speed * viscosity_around(model, 0, speed, d);
  EXPECT_NEAR(drag, 3 * 3.14159265358979 * d * (0.4 * speed + 7 * 3.14159265358979 / 24 * 12 * d), 1e-12);
}

TEST(Pressure, IsZeroAtRestVolumeAndRhoCSquaredTimesStrain) {
  EXPECT_EQ(pressure_of(1000, 20, 1.0), 0.0);
  EXPECT_NEAR(pressure_of(1000, 20, 1.0 - 1e-6), 1000 * 400 * 1e-6, 1e-6);
  EXPECT_LT(pressure_of(1000, 20, 1.01), 0.0);
}

}  // namespace
}  // namespace sluice
