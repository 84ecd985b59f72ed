#pragma once
/// What the fluid is made of: equation of state, rheology, slurry. Plain parameters and pure functions.

#include "base/schema.h"

namespace sluice {

/// Keys under `water: fluid:`.
struct FluidModel {
  double density = 1000;        ///< of the clear liquid [kg/m3]
  double viscosity = 1e-3;      ///< of the clear liquid [Pa s]
  double fines_density = 2700;  ///< of the fines' grains [kg/m3]
  double packing = 0.6;         ///< volume fraction of fines at which the slurry stops flowing
  void keys(Schema& s);
};

/// Density of a slurry whose volume fraction of fines is phi [kg/m3].
double slurry_density(const FluidModel& model, double phi);
/// The phi of a slurry that has this density [kg/m3], within 0 .. 0.95 packing: the inverse of the above.
/// @pre grains and liquid differ in density
double fines_fraction(const FluidModel& model, double density);
/// Viscosity of that slurry [Pa s]: Krieger & Dougherty (1959), mu (1 - phi/packing)^(-2.5 packing).
/// @pre 0 <= phi < packing
double slurry_viscosity(const FluidModel& model, double phi);
/// Weakly compressible: p = rho0 c^2 (1/J - 1) [Pa]; J volume ratio.
double pressure_of(double density, double sound_speed, double J);

}  // namespace sluice
