#include "validation/coupling_stream.h"

#include <fmt/format.h>

#include <cmath>

#include "validation/coupling_scenes.h"

namespace sluice {

void CouplingStream::keys(Schema& s) {
  s.number("size_cells", size_cells, {.above = 0, .at_most = 16, .doc = "size of the rock over the spacing"});
  s.number("resolve_from", resolve_from,
           {.at_least = 3, .doc = "of the coupling: from this size over the spacing on it is resolved"});
  s.number("sizes", sizes,
           {.above = 0, .doc = "of the rock that the stream passes; the second half is read"});
}

Measured CouplingStream::run(const CsvTable& reference) const {
  const std::vector<double> diameter = reference_numbers(reference, "diameter");
  const std::vector<double> stream = reference_numbers(reference, "stream");
  const std::vector<double> drag = reference_numbers(reference, "drag");
  Measured out;
  for (std::size_t k = 0; k < diameter.size(); ++k) {
    const double d = diameter[k], h = d / size_cells;
    ImmersedSetup setup;
    setup.rock_density = 1e7;  // held: drag does not move it
    setup.rock_size = d;
    setup.coupling.resolve_from = resolve_from;
    setup.water.config.spacing = h;
    setup.water.config.fastest_bulk_speed = stream[k];
    double cells = 16;  // levels of the coupling grid are two, four, ... cells
    while (cells * h < setup.coupling.kernel_diameters * d) cells *= 2;
    const double width = cells * h;
    setup.water.domain = water_domain({Vec3::Zero(), Vec3::Constant(width)}, {true, true, true});
    ImmersedScene scene(setup, {});
    WaterFill fill;
    fill.box = setup.water.domain.box;
    fill.jitter = 0.1;
    fill.velocity = [&](const Vec3&) { return Vec3(stream[k], 0, 0); };
    scene.fluid.fill(fill);
    scene.rocks->add({.x = width * Vec3(0.43, 0.52, 0.57), .size = d});
    scene.coupling->make_room();
    const double passes = sizes * d / stream[k];
    double sum = 0, looks = 0;
    while (scene.fluid.t < passes) {
      scene.step();
      if (scene.fluid.t < 0.5 * passes) continue;
      sum += scene.coupling->force()[0].x();
      looks += 1;
    }
    out.particle_steps += scene.fluid.point_steps;
    out.values.push_back(
        {fmt::format("drag, d = {} mm, {} m/s [N]", 1e3 * d, stream[k]), sum / looks, drag[k], drag[k]});
  }
  return out;
}

}  // namespace sluice
