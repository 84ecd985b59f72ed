#include "mpm/mpm_system.h"

#include <algorithm>
#include <cmath>

#include "mpm/explicit_mpm.h"

namespace sluice {

void MpmConfig::keys(Schema& s) {
  s.number(
      "spacing", spacing,
      {.unit = "m", .required = true, .above = 0, .doc = "grid spacing of the water", .example = "20 mm"});
  s.integer("points_per_cell_axis", points_per_cell_axis,
            {.at_least = 1, .at_most = 4, .doc = "water points along each axis of a full cell"});
  s.number(
      "fastest_bulk_speed", fastest_bulk_speed,
      {.unit = "m/s", .above = 0, .doc = "fastest water in bulk, sprays apart; sound is ten times as fast"});
  s.number(
      "fastest_speed", fastest_speed,
      {.unit = "m/s", .at_least = 0, .doc = "fastest water at all, sprays included; 0 = the bulk speed"});
  s.number("deepest", deepest, {.unit = "m", .at_least = 0, .doc = "greatest depth of standing water"});
  s.number("sound_speed", sound_speed,
           {.unit = "m/s",
            .above = 0,
            .doc = "instead of ten times the larger of bulk speed and sqrt(2 g deepest)"});
  s.number("courant", courant,
           {.above = 0, .at_most = 0.6, .doc = "time step over h / (sound speed + speed)"});
  s.choice("wall_slip", wall_slip,
           {{"slip", WallSlip::slip},
            {"no_slip", WallSlip::no_slip},
            {"turbulent_film", WallSlip::turbulent_film}},
           {.doc = "how walls brake water: not at all, by its viscosity (where some cells resolve the "
                   "sheared layer), or as a turbulent film by rho f/8 |u| u"});
  s.number("film_friction", film_friction,
           {.at_least = 0,
            .at_most = 0.2,
            .doc = "Darcy friction factor f of the film",
            .applies = wall_slip == WallSlip::turbulent_film,
            .applies_to = "wall_slip: turbulent_film"});
  s.choice("precision", precision, {{"single", Precision::single}, {"reference", Precision::reference}},
           {.doc = "single for production; reference is the same scheme in double, to check it against"});
  s.flag("keep_tension", keep_tension,
         {.doc = "keep pressure below zero: only for periodic boxes that are full of water"});
  s.section("fluid", fluid, {.doc = "what the water is made of"});
}

FluidStepLimits step_limits(const MpmConfig& config, const Vec3& gravity, double largest_kinematic_viscosity,
                            double fastest_wall) {
  const double bulk = std::max(config.fastest_bulk_speed, std::sqrt(2 * gravity.norm() * config.deepest));
  const double fastest = std::max({bulk, config.fastest_speed, fastest_wall});
  FluidStepLimits limits;
  limits.sound_speed = config.sound_speed.value_or(10 * bulk);
  limits.acoustic = config.courant * config.spacing / (limits.sound_speed + fastest);
  limits.viscous = largest_kinematic_viscosity > 0
                       ? config.spacing * config.spacing / (6 * largest_kinematic_viscosity)
                       : std::numeric_limits<double>::infinity();
  const bool viscous = limits.viscous < limits.acoustic;
  limits.step = viscous ? limits.viscous : limits.acoustic;
  limits.governed_by = viscous ? "water viscosity" : "water sound and speed";
  return limits;
}

std::unique_ptr<FluidSystem> make_mpm(const MpmConfig& config, const Domain& domain, const Vec3& gravity,
                                      const Walls& walls) {
  if (config.precision == Precision::reference)
    return std::make_unique<ExplicitMpm<double>>(config, domain, gravity, walls);
  return std::make_unique<ExplicitMpm<float>>(config, domain, gravity, walls);
}

}  // namespace sluice
