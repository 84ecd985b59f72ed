#include "validation/water_film.h"

#include <fmt/format.h>

#include <cmath>

#include "validation/water_scenes.h"

namespace sluice {

void WaterFilm::keys(Schema& s) {
  s.number("cells", cells, {.above = 0, .doc = "grid cells across the sheet"});
  s.number("thickness", thickness, {.unit = "m", .above = 0, .doc = "of the sheet"});
  s.number("slope", slope, {.unit = "rad", .above = 0, .below = 1.5, .doc = "of the bed"});
  s.number("friction", friction, {.above = 0, .doc = "Darcy's f of the bed"});
  s.number("seconds", seconds, {.unit = "s", .above = 0, .doc = "how long it runs; the last quarter counts"});
}

Measured WaterFilm::run(const CsvTable& reference) const {
  const double expected = reference_numbers(reference, "speed_ratio").front();
  constexpr double g = 9.81;
  const double h = thickness / cells, length = 8 * h, width = 4 * h;
  const double steady = std::sqrt(8 * g * thickness * std::sin(slope) / friction);
  Measured out;
  for (const double place : {0.0, 0.25, 0.5}) {  // of the bed between two nodes
    const double bed = place * h, top = bed + 2 * thickness + 4 * h;
    WaterSetup setup;
    setup.config.spacing = h;
    setup.config.fastest_bulk_speed = 1.5 * steady;
    setup.config.deepest = thickness;
    setup.config.wall_slip = WallSlip::turbulent_film;
    setup.config.film_friction = friction;
    setup.gravity = {g * std::sin(slope), 0, -g * std::cos(slope)};
    setup.domain = water_domain({Vec3(0, 0, -h), Vec3(length, width, top)}, {true, true, false});
    WaterScene scene(setup,
                     {sheet("bed", {Vec3(-length, -width, bed), Vec3(2 * length, -width, bed),
                                    Vec3(2 * length, 2 * width, bed), Vec3(-length, 2 * width, bed)})});
    WaterFill fill;
    fill.box = {Vec3(0, 0, bed), Vec3(length, width, bed + thickness)};
    fill.velocity = [&](const Vec3&) { return Vec3(steady, 0, 0); };
    scene.fill(fill);
    double sum = 0, looks = 0;
    for (int n = 0; scene.t < seconds; ++n) {
      scene.step();
      if (scene.t < 0.75 * seconds || n % 10 != 0) continue;
      sum += scene.water->momentum().x() / scene.water->total_mass();
      looks += 1;
    }
    out.particle_steps += scene.point_steps;
    out.values.push_back({fmt::format("mean speed over the steady one, bed {} cells from a node", place),
                          sum / looks / steady, expected, expected});
  }
  return out;
}

}  // namespace sluice
