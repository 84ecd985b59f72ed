#pragma once
/// What the fluid is made of: equation of state, rheology, slurry. Plain parameters and pure functions.

#include "base/schema.h"

namespace sluice {

enum class Rheology { newtonian, bingham, herschel_bulkley };

/// Keys under `water: fluid:`.
///
/// Bingham and Herschel-Bulkley: stress = yield stress + K rate^n, the rate of shear sqrt(2 D:D). Both terms
/// are regularised, so that a fluid at rest creeps instead of standing: the yield stress by Papanastasiou
/// (1987, J. Rheol. 31:385), tau_y (1 - exp(-rate / r)), and K rate^n by rate (rate^2 + r^2)^((n - 1) / 2),
/// with r the `yield_rate`.
struct FluidModel {
  double density = 1000;    ///< of the clear liquid [kg/m3]
  double viscosity = 1e-3;  ///< of the clear liquid [Pa s]; K [Pa s^n] where n is not 1
  Rheology rheology = Rheology::newtonian;
  double yield_stress = 0;      ///< of the clear liquid [Pa]
  double flow_index = 1;        ///< n
  double yield_rate = 0.1;      ///< r [1/s]
  double fines_density = 2700;  ///< of the fines' grains [kg/m3]
  double packing = 0.6;         ///< volume fraction of fines at which the slurry stops flowing
  void keys(Schema& s);
};

/// Density of a slurry whose volume fraction of fines is phi [kg/m3].
double slurry_density(const FluidModel& model, double phi);
/// The phi of a slurry that has this density [kg/m3], within 0 .. 0.95 packing: the inverse of the above.
/// 0 where grains and liquid are as dense as each other.
double fines_fraction(const FluidModel& model, double density);
/// Viscosity of that slurry [Pa s]: Krieger & Dougherty (1959), mu (1 - phi/packing)^(-2.5 packing).
/// @pre 0 <= phi < packing
double slurry_viscosity(const FluidModel& model, double phi);

/// What a slurry's stress follows: yield stress [Pa] and K [Pa s^n].
struct FlowCurve {
  double yield_stress = 0, consistency = 0;
};
/// That of a slurry: with grains, the liquid between them is sheared faster and fills less of the space,
/// K g^((n + 1) / 2) (1 - phi)^((1 - n) / 2) and tau_y sqrt(g (1 - phi)), where g is the factor of Krieger &
/// Dougherty on a Newtonian liquid (Chateau, Ovarlez & Trung 2008, J. Rheol. 52:489).
FlowCurve flow_curve(const FluidModel& model, double phi);
/// Stress over rate of shear [Pa s], regularised; of a Newtonian liquid its viscosity. @param rate  [1/s]
double apparent_viscosity(const FluidModel& model, const FlowCurve& curve, double rate);
/// The largest that a slurry can have, which bounds the time step: at rest [Pa s].
double largest_viscosity(const FluidModel& model, double phi);
/// What a sphere meets that moves at `speed` [m/s] through the fluid: the viscosity with which drag laws for
/// Newtonian fluids hold [Pa s]. K (U/d)^(n - 1) + (7 pi / 24) tau_y d / U (Atapattu, Chhabra & Uhlherr 1995,
/// J. Non-Newton. Fluid Mech. 59:245), regularised like the above.
double viscosity_around(const FluidModel& model, double phi, double speed, double diameter);
/// Weakly compressible: p = rho0 c^2 (1/J - 1) [Pa]; J volume ratio.
double pressure_of(double density, double sound_speed, double J);

}  // namespace sluice
