#include "validation/coupling_added_mass.h"

#include <fmt/format.h>

#include <cmath>

#include "validation/coupling_scenes.h"

namespace sluice {

void CouplingAddedMass::keys(Schema& s) {
  s.number("size_cells", size_cells,
           {.at_least = 3, .at_most = 40, .doc = "diameter of the sphere over the spacing"});
}

Measured CouplingAddedMass::run(const CsvTable& reference) const {
  constexpr double d = 0.1, pull = 1, sizes_wide = 4;  // [m], [m/s2]
  const std::vector<double> ratio = reference_numbers(reference, "ratio");
  const std::vector<double> expected = reference_numbers(reference, "acceleration");
  Measured out;
  for (std::size_t k = 0; k < ratio.size(); ++k) {
    const double h = d / size_cells, width = h * std::round(sizes_wide * size_cells);
    ImmersedSetup setup;
    setup.rock_density = 1000 * ratio[k];
    setup.rock_size = d;
    setup.rock_gravity = Vec3(0, 0, -pull);
    setup.coupling.resolve_from = 3;
    setup.water.config.spacing = h;
    setup.water.config.fastest_bulk_speed = 1;
    setup.water.config.wall_slip = WallSlip::slip;
    setup.water.config.keep_tension = true;  // full
    setup.water.domain = water_domain({Vec3::Zero(), Vec3::Constant(width)}, {true, true, true});
    ImmersedScene scene(setup, {});
    WaterFill fill;
    fill.box = setup.water.domain.box;
    fill.jitter = 0.1;
    scene.fluid.fill(fill);
    const Vec3 start = Vec3::Constant(0.5 * width) + h * Vec3(0.13, 0.23, 0.31);
    scene.rocks->add({.x = start, .size = d});
    scene.coupling->make_room();
    double moved = 0;
    while (moved < d / 20 && scene.fluid.t < 1) {
      scene.step();
      moved = start.z() - scene.rocks->rocks().x[0].z();
    }
    const double v = scene.rocks->rocks().v[0].z();
    out.particle_steps += scene.fluid.point_steps;
    out.values.push_back({fmt::format("acceleration, {} times as dense as the liquid", ratio[k]),
                          v * v / (2 * moved) / pull, expected[k], expected[k]});
  }
  return out;
}

}  // namespace sluice
