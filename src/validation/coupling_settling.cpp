#include "validation/coupling_settling.h"

#include <fmt/format.h>

#include <cmath>

#include "base/errors.h"
#include "validation/coupling_scenes.h"

namespace sluice {

void CouplingSettling::keys(Schema& s) {
  s.number("spacing_diameters", spacing_diameters,
           {.above = 0, .doc = "grid spacing over the rock's diameter"});
  s.choice("mode", mode, {{"two_way", CouplingMode::two_way}, {"one_way", CouplingMode::one_way}},
           {.doc = "whether the water feels the rock"});
  s.choice("drag", drag, drag_models, {.doc = "law of drag; another than the reference's is a fault"});
  s.number("depth", depth, {.unit = "m", .above = 0, .doc = "of the water"});
}

Measured CouplingSettling::run(const CsvTable& reference) const {
  const std::vector<double> diameter = reference_numbers(reference, "diameter");
  const std::vector<double> density = reference_numbers(reference, "density");
  const std::vector<double> fluid_density = reference_numbers(reference, "fluid_density");
  const std::vector<double> viscosity = reference_numbers(reference, "viscosity");
  const std::vector<double> speed = reference_numbers(reference, "speed");
  constexpr double g = 9.81;
  Measured out;
  for (std::size_t k = 0; k < diameter.size(); ++k) {
    const double d = diameter[k], h = spacing_diameters * d, width = h * std::ceil(std::max(4.0, 16 * d / h));
    ImmersedSetup setup;
    setup.rock_density = density[k];
    setup.rock_size = d;
    setup.coupling.mode = mode;
    setup.coupling.drag = drag;
    setup.water.config.spacing = h;
    setup.water.config.fastest_bulk_speed = 1;
    setup.water.config.deepest = depth;
    setup.water.config.fluid.density = fluid_density[k];
    setup.water.config.fluid.viscosity = viscosity[k];
    setup.water.gravity = {0, 0, -g};
    setup.water.domain =
        water_domain({Vec3(0, 0, -h), Vec3(width, width, depth + 8 * h)}, {true, true, false});
    ImmersedScene scene(setup, {sheet("floor", {Vec3(-width, -width, 0), Vec3(2 * width, -width, 0),
                                                Vec3(2 * width, 2 * width, 0), Vec3(-width, 2 * width, 0)})});
    const double c = scene.fluid.water->limits().sound_speed;
    WaterFill fill;
    fill.box = {Vec3::Zero(), Vec3(width, width, depth)};
    fill.pressure = [&](const Vec3& x) { return still_pressure(fluid_density[k], g, c, depth - x.z()); };
    scene.fluid.fill(fill);
    scene.rocks->add({.x = {0.5 * width, 0.5 * width, 0.875 * depth}, .size = d});
    double from_t = 0, from_z = 0, to_t = 0, to_z = 0;
    while (scene.rocks->rocks().x[0].z() > 0.3 * depth) {
      scene.step();
      const double z = scene.rocks->rocks().x[0].z();
      if (scene.fluid.t > 10 * depth / speed[k])
        throw NumericalError("settling", scene.fluid.t, fmt::format("the rock hangs at z = {:.3g} m", z),
                             "check drag and buoyancy");
      if (z > 0.55 * depth) {
        from_t = scene.fluid.t;
        from_z = z;
      }
      to_t = scene.fluid.t;
      to_z = z;
    }
    out.particle_steps += scene.fluid.point_steps;
    out.values.push_back({fmt::format("terminal speed, d = {} mm, {} kg/m3 [m/s]", 1e3 * d, density[k]),
                          (from_z - to_z) / (to_t - from_t), speed[k], speed[k]});
  }
  return out;
}

}  // namespace sluice
