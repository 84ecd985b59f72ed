#include "validation/coupling_hindered.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "validation/coupling_scenes.h"

namespace sluice {

void CouplingHindered::keys(Schema& s) {
  s.number("spacing_diameters", spacing_diameters,
           {.above = 0, .doc = "grid spacing over the rocks' diameter"});
  s.choice("drag", drag, drag_models, {.doc = "law of drag"});
  s.number("size", size, {.unit = "m", .above = 0, .doc = "diameter of the rocks"});
  s.number("depth", depth, {.unit = "m", .above = 0, .doc = "of the water"});
  s.number("width", width, {.unit = "m", .above = 0, .doc = "of the container, periodic"});
  s.number("settle", settle, {.unit = "s", .at_least = 0, .doc = "before speeds are read"});
  s.number("seconds", seconds, {.unit = "s", .above = 0, .doc = "for which speeds are read"});
}

double terminal_speed(DragModel drag, double diameter, double density, const FluidModel& fluid,
                      double gravity) {
  const double weight = std::numbers::pi / 6 * std::pow(diameter, 3) * (density - fluid.density) * gravity;
  double low = 0, high = 100;
  for (int i = 0; i < 200; ++i) {
    DragInput in{fluid.density, fluid.viscosity, diameter, 1, 0.5 * (low + high)};
    (drag_per_speed(drag, in) * in.speed < weight ? low : high) = in.speed;
  }
  return low;
}

Measured CouplingHindered::run(const CsvTable& reference) const {
  const std::vector<double> concentration = reference_numbers(reference, "concentration");
  const std::vector<double> exponent = reference_numbers(reference, "exponent");
  constexpr double g = 9.81;
  Measured out;
  for (std::size_t k = 0; k < concentration.size(); ++k) {
    const double h = spacing_diameters * size, top = 0.9 * depth;
    ImmersedSetup setup;
    setup.rock_size = size;
    setup.coupling.drag = drag;
    setup.water.config.spacing = h;
    setup.water.config.fastest_bulk_speed = 1;
    setup.water.config.deepest = depth;
    setup.water.gravity = {0, 0, -g};
    setup.water.domain = water_domain({Vec3(0, 0, -h), Vec3(width, width, 1.5 * depth)}, {true, true, false});
    ImmersedScene scene(setup, {sheet("floor", {Vec3(-width, -width, 0), Vec3(2 * width, -width, 0),
                                                Vec3(2 * width, 2 * width, 0), Vec3(-width, 2 * width, 0)})});
    const double c = scene.fluid.water->limits().sound_speed;
    WaterFill fill;
    fill.box = {Vec3::Zero(), Vec3(width, width, depth)};
    fill.pressure = [&](const Vec3& x) {
      return still_pressure(setup.water.config.fluid.density, g, c, depth - x.z());
    };
    scene.fluid.fill(fill);
    const double volume = std::numbers::pi / 6 * std::pow(size, 3);
    const auto wanted = static_cast<std::size_t>(concentration[k] * width * width * (top - size) / volume);
    Random random(9, k);
    while (scene.rocks->rocks().count() < wanted) {
      const Vec3 x(random.uniform(0, width), random.uniform(0, width),
                   random.uniform(0.5 * size, top - 0.5 * size));
      if (scene.rocks->has_room(x, 0.5 * size, true)) scene.rocks->add({.x = x, .size = size});
    }
    const double alone = terminal_speed(drag, size, setup.rock_density, setup.water.config.fluid, g);
    const double low = 0.2 * depth, high = 0.45 * depth;  // between the sediment and the falling front
    const auto inside = [&](const Vec3& x) { return x.z() >= low && x.z() < high; };
    double fall = 0, rocks_seen = 0, rise = 0, water_seen = 0, looks = 0;
    for (int n = 0; scene.fluid.t < settle + seconds; ++n) {
      scene.step();
      if (scene.fluid.t < settle || n % 10 != 0) continue;
      const Rocks& rocks = scene.rocks->rocks();
      for (std::size_t i = 0; i < rocks.count(); ++i) {
        if (!inside(rocks.x[i])) continue;
        fall -= rocks.v[i].z();
        rocks_seen += 1;
      }
      const WaterPoints water = scene.fluid.water->points();
      for (std::size_t i = 0; i < water.count(); ++i) {
        if (!inside(water.x[i])) continue;
        rise += water.mass[i] * water.v[i].z();
        water_seen += water.mass[i];
      }
      looks += 1;
    }
    out.particle_steps += scene.fluid.point_steps;
    const double solids = rocks_seen / looks * volume / (width * width * (high - low));
    const double slip = fall / rocks_seen + rise / water_seen;
    const double expected = std::pow(1 - solids, exponent[k]);
    out.values.push_back(
        {fmt::format("speed over that of one alone, {:.1f} % solids where it is read", 100 * solids),
         (1 - solids) * slip / alone, expected, expected});
  }
  return out;
}

}  // namespace sluice
