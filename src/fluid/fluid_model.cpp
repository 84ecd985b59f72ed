#include "fluid/fluid_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sluice {

void FluidModel::keys(Schema& s) {
  s.number("density", density,
           {.unit = "kg/m3", .above = 0, .doc = "density of the clear liquid", .example = "1000 kg/m3"});
  s.number("viscosity", viscosity,
           {.unit = "Pa s",
            .at_least = 0,
            .doc = "viscosity of the clear liquid; with a yield stress the plastic viscosity; with a "
                   "'flow_index' the consistency, its stress beyond yield at a shear rate of 1/s",
            .example = "1e-3 Pa s"});
  s.choice("rheology", rheology,
           {{"newtonian", Rheology::newtonian},
            {"bingham", Rheology::bingham},
            {"herschel_bulkley", Rheology::herschel_bulkley}},
           {.doc = "stress over shear rate: viscosity; with a yield stress; with a yield stress and a power "
                   "of the rate"});
  const bool yields = rheology != Rheology::newtonian;
  s.number("yield_stress", yield_stress,
           {.unit = "Pa",
            .required = yields,
            .at_least = 0,
            .doc = "stress below which the fluid does not flow",
            .applies = yields,
            .applies_to = "rheology: bingham or herschel_bulkley",
            .example = "20 Pa"});
  s.number("flow_index", flow_index,
           {.required = rheology == Rheology::herschel_bulkley,
            .at_least = 0.1,
            .at_most = 1,
            .doc = "power of the shear rate, 1 or less (shear-thinning)",
            .applies = rheology == Rheology::herschel_bulkley,
            .applies_to = "rheology: herschel_bulkley"});
  s.number(
      "yield_rate", yield_rate,
      {.unit = "1/s",
       .above = 0,
       .doc = "shear rate below which stress falls to zero, so that the fluid creeps instead of standing "
              "(Papanastasiou); smaller is nearer to standing and may shorten the step",
       .applies = yields,
       .applies_to = "rheology: bingham or herschel_bulkley",
       .example = "0.1 1/s"});
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
  if (model.fines_density == model.density) return 0;
  return std::clamp((density - model.density) / (model.fines_density - model.density), 0.0,
                    0.95 * model.packing);
}

double slurry_viscosity(const FluidModel& model, double phi) {
  if (phi <= 0) return model.viscosity;
  return model.viscosity * std::pow(1.0 - phi / model.packing, -2.5 * model.packing);
}

FlowCurve flow_curve(const FluidModel& model, double phi) {
  if (phi <= 0) return {model.yield_stress, model.viscosity};
  const double n = model.flow_index, thicker = std::pow(1.0 - phi / model.packing, -2.5 * model.packing);
  return {model.yield_stress * std::sqrt(thicker * (1 - phi)),
          model.viscosity * std::pow(thicker, 0.5 * (n + 1)) * std::pow(1 - phi, 0.5 * (1 - n))};
}

double apparent_viscosity(const FluidModel& model, const FlowCurve& curve, double rate) {
  const double r = model.yield_rate, x = rate / r;
  const double yielding = x > 1e-8 ? -std::expm1(-x) / x : 1.0;
  const double thinning =
      model.flow_index == 1 ? 1.0 : std::pow(rate * rate + r * r, 0.5 * (model.flow_index - 1));
  return curve.consistency * thinning + curve.yield_stress / r * yielding;
}

double largest_viscosity(const FluidModel& model, double phi) {
  return apparent_viscosity(model, flow_curve(model, phi), 0);
}

double viscosity_around(const FluidModel& model, double phi, double speed, double diameter) {
  FlowCurve curve = flow_curve(model, phi);
  curve.yield_stress *= 7 * std::numbers::pi / 24;
  return apparent_viscosity(model, curve, speed / diameter);
}

double pressure_of(double density, double sound_speed, double J) {
  return density * sound_speed * sound_speed * (1.0 / J - 1.0);
}

}  // namespace sluice
