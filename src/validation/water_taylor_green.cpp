#include "validation/water_taylor_green.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "validation/water_scenes.h"

namespace sluice {

void WaterTaylorGreen::keys(Schema& s) {
  s.number("cells", cells, {.at_least = 8, .doc = "grid cells along a side"});
  s.number("reynolds", reynolds, {.above = 0, .doc = "U L / nu"});
  s.number("mach", mach, {.above = 0, .at_most = 0.2, .doc = "U over the speed of sound"});
}

Measured WaterTaylorGreen::run(const CsvTable& reference) const {
  const std::vector<double> time = reference_numbers(reference, "time");
  const std::vector<double> energy = reference_numbers(reference, "energy");
  const double h = 1 / cells, k = 2 * std::numbers::pi;  // L = 1 m, U = 1 m/s
  WaterSetup setup;
  setup.config.spacing = h;
  setup.config.sound_speed = 1 / mach;
  setup.config.keep_tension = true;
  setup.config.fluid.viscosity = setup.config.fluid.density / reynolds;
  setup.domain = water_domain({Vec3::Zero(), Vec3(1, 1, 4 * h)}, {true, true, true});
  WaterScene scene(setup, {});
  WaterFill fill;
  fill.box = setup.domain.box;
  fill.velocity = [k](const Vec3& x) {
    return Vec3(-std::cos(k * x.x()) * std::sin(k * x.y()), std::sin(k * x.x()) * std::cos(k * x.y()), 0);
  };
  const double density = setup.config.fluid.density;
  fill.pressure = [k, density](const Vec3& x) {
    return -density / 4 * (std::cos(2 * k * x.x()) + std::cos(2 * k * x.y()));
  };
  scene.fill(fill);
  const double start = scene.water->kinetic_energy();
  Measured out;
  for (std::size_t n = 0; n < time.size(); ++n) {
    scene.run_to(time[n]);
    out.values.push_back({fmt::format("kinetic energy at t = {} L/U", time[n]),
                          scene.water->kinetic_energy() / start, energy[n], 1});
  }
  out.particle_steps = scene.point_steps;
  return out;
}

}  // namespace sluice
