#include "validation/water_slot.h"

#include <fmt/format.h>

#include <cmath>

#include "validation/water_scenes.h"

namespace sluice {

void WaterSlot::keys(Schema& s) {
  s.number("cells", cells, {.at_least = 1, .doc = "grid cells across the slot"});
  s.number("slot", slot, {.unit = "m", .above = 0, .doc = "its width"});
  s.number("depth", depth, {.unit = "m", .above = 0, .doc = "of water at the start"});
  s.number("tank_over_slot", tank_over_slot, {.above = 2, .doc = "width of the tank over that of the slot"});
  s.number("settle", settle, {.unit = "s", .at_least = 0, .doc = "before counting begins"});
  s.number("seconds", seconds, {.unit = "s", .above = 0, .doc = "for which it is counted"});
}

Measured WaterSlot::run(const CsvTable& reference) const {
  const double expected = reference_numbers(reference, "coefficient").front();
  constexpr double g = 9.81;
  const double h = slot / cells, width = 4 * h, half = 0.5 * tank_over_slot * slot, top = 1.3 * depth;
  WaterSetup setup;
  setup.config.spacing = h;
  setup.config.fastest_bulk_speed = 0.5;
  setup.config.deepest = depth;
  setup.config.wall_slip = WallSlip::slip;
  setup.gravity = {0, 0, -g};
  setup.domain =
      water_domain({Vec3(-half - h, 0, -5 * slot), Vec3(half + h, width, top)}, {false, true, false});
  std::vector<Wall> walls;
  for (const double side : {-1.0, 1.0}) {
    const double near = side * 0.5 * slot, far = side * half;
    walls.push_back(sheet("floor", {Vec3(near, -width, 0), Vec3(far, -width, 0), Vec3(far, 2 * width, 0),
                                    Vec3(near, 2 * width, 0)}));
    walls.push_back(sheet("side", {Vec3(far, -width, 0), Vec3(far, 2 * width, 0), Vec3(far, 2 * width, top),
                                   Vec3(far, -width, top)}));
  }
  WaterScene scene(setup, std::move(walls));
  const double c = scene.water->limits().sound_speed, density = setup.config.fluid.density;
  WaterFill fill;
  fill.box = {Vec3(-half, 0, 0), Vec3(half, width, depth)};
  fill.pressure = [&](const Vec3& x) { return still_pressure(density, g, c, depth - x.z()); };
  scene.fill(fill);

  const auto in_tank = [&] {
    const WaterPoints p = scene.water->points();
    double mass = 0;
    for (std::size_t i = 0; i < p.count(); ++i) mass += p.x[i].z() > 0 ? p.mass[i] : 0;
    return mass;
  };
  while (scene.t < settle) {
    scene.step();
    scene.water->remove_outside();
  }
  const double approach = expected / tank_over_slot;
  const double before = in_tank();
  double ideal = 0, tank = before, last = scene.t;
  const double end = scene.t + seconds;
  for (int n = 1; scene.t < end; ++n) {
    scene.step();
    scene.water->remove_outside();
    if (n % 20 != 0 && scene.t < end) continue;
    const double now = in_tank(), level = 0.5 * (tank + now) / (density * 2 * half * width);
    ideal += (scene.t - last) * density * slot * width * std::sqrt(2 * g * level / (1 - approach * approach));
    tank = now;
    last = scene.t;
  }
  Measured out;
  out.particle_steps = scene.point_steps;
  out.values.push_back({"discharge coefficient", (before - tank) / ideal, expected, expected});
  return out;
}

}  // namespace sluice
