#include "validation/coupling_sphere.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/coupling_scenes.h"

namespace sluice {

void CouplingSphere::keys(Schema& s) {
  s.number("size_cells", size_cells,
           {.at_least = 3, .at_most = 40, .doc = "diameter of the sphere over the spacing"});
}

Measured CouplingSphere::run(const CsvTable& reference) const {
  constexpr double d = 0.015, density = 1120, width = 0.1, height = 0.16, released = 0.12;
  const std::vector<double> liquid = reference_numbers(reference, "density");
  const std::vector<double> viscosity = reference_numbers(reference, "viscosity");
  const std::vector<double> touchdown = reference_numbers(reference, "touchdown");
  const std::vector<double> fastest = reference_numbers(reference, "fastest");
  Measured out;
  for (std::size_t k = 0; k < liquid.size(); ++k) {
    const double h = d / size_cells;
    ImmersedSetup setup;
    setup.rock_density = density;
    setup.rock_size = d;
    setup.rock_gravity = Vec3(0, 0, -9.81 * (1 - liquid[k] / density));
    setup.coupling.resolve_from = 3;
    setup.water.config.spacing = h;
    setup.water.config.fluid.density = liquid[k];
    setup.water.config.fluid.viscosity = viscosity[k];
    setup.water.config.fastest_bulk_speed = 1.2 * fastest[k];
    setup.water.config.wall_slip = WallSlip::no_slip;
    setup.water.config.keep_tension = true;  // a closed vessel, full to its lid
    const Box tank{Vec3::Zero(), Vec3(width, width, height)};
    setup.water.domain = water_domain(tank.grown(h), {false, false, false});
    Wall vessel;
    vessel.name = "vessel";
    vessel.mesh = make_box("vessel", tank);
    ImmersedScene scene(setup, {vessel});
    WaterFill fill;
    fill.box = tank;
    fill.jitter = 0.1;
    scene.fluid.fill(fill);
    scene.rocks->add({.x = {width / 2, width / 2, released + d / 2}, .size = d});
    scene.coupling->make_room();
    double peak = 0;
    while (scene.fluid.t < 0.65 * touchdown[k]) {
      scene.step();
      peak = std::max(peak, -scene.rocks->rocks().v[0].z());
    }
    out.particle_steps += scene.fluid.point_steps;
    out.values.push_back(
        {fmt::format("greatest speed in {:.3g} Pa s [m/s]", viscosity[k]), peak, fastest[k], fastest[k]});
  }
  return out;
}

}  // namespace sluice
