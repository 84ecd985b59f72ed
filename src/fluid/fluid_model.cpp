#include "fluid/fluid_model.h"

#include <algorithm>
#include <cmath>

namespace sluice {

void FluidModel::keys(Schema& s) {
  s.number("density", density,
           {.unit = "kg/m3", .above = 0, .doc = "density of the clear liquid", .example = "1000 kg/m3"});
  s.number("viscosity", viscosity,
           {.unit = "Pa s", .at_least = 0, .doc = "viscosity of the clear liquid", .example = "1e-3 Pa s"});
  s.number("fines_density", fines_density,
           {.unit = "kg/m3",
            .above = 0,
            .doc = "density of the fines' grains (rock below the cut-off size, carried as slurry)",
            .example = "2700 kg/m3"});
  s.number("packing", packing,
           {.above = 0,
            .at_most = 0.74,
            .doc = "volume fraction of fines at which the slurry stops flowing (Krieger & Dougherty)"});
}

double slurry_density(const FluidModel& model, double phi) {
  return model.density + phi * (model.fines_density - model.density);
}

double fines_fraction(const FluidModel& model, double density) {
  return std::clamp((density - model.density) / (model.fines_density - model.density), 0.0,
                    0.95 * model.packing);
}

double slurry_viscosity(const FluidModel& model, double phi) {
  return model.viscosity * std::pow(1.0 - phi / model.packing, -2.5 * model.packing);
}

double pressure_of(double density, double sound_speed, double J) {
  return density * sound_speed * sound_speed * (1.0 / J - 1.0);
}

}  // namespace sluice
