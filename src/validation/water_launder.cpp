#include "validation/water_launder.h"

#include <fmt/format.h>

#include <cmath>

#include "inflow/channel_inflow.h"
#include "validation/water_scenes.h"

namespace sluice {

void WaterLaunder::keys(Schema& s) {
  s.number("cells", cells, {.at_least = 1, .doc = "grid cells in the depth"});
  s.number("depth", depth, {.unit = "m", .above = 0, .doc = "of the water that comes"});
  s.number("speed", speed, {.unit = "m/s", .above = 0, .doc = "of the water that comes"});
  s.number("seconds", seconds, {.unit = "s", .above = 0, .doc = "how long it runs; the last half counts"});
}

Measured WaterLaunder::run(const CsvTable& reference) const {
  const std::vector<double> place = reference_numbers(reference, "place");
  constexpr double g = 9.81;
  const double h = depth / cells, width = 6 * h, length = (place.back() + 2) * depth;
  WaterSetup setup;
  setup.config.spacing = h;
  setup.config.fastest_bulk_speed = speed;
  setup.config.deepest = depth;
  setup.config.wall_slip = WallSlip::slip;
  setup.gravity = {0, 0, -g};
  const double top = 2 * depth + 2 * h;
  setup.domain = water_domain({Vec3(-2 * h, -h, -h), Vec3(length, width + h, top)}, {false, false, false});
  std::vector<Wall> walls;
  walls.push_back(sheet("bed", {Vec3(-2 * h, -h, 0), Vec3(length + h, -h, 0), Vec3(length + h, width + h, 0),
                                Vec3(-2 * h, width + h, 0)}));
  for (const double y : {0.0, width})
    walls.push_back(sheet("side", {Vec3(-2 * h, y, -h), Vec3(length + h, y, -h), Vec3(length + h, y, top),
                                   Vec3(-2 * h, y, top)}));
  WaterScene scene(setup, std::move(walls));
  ChannelInflowConfig config;
  config.name = "channel";
  config.width = width;
  config.depth = depth;
  config.outlets.position = {0, 0.5 * width, 0.5 * depth};
  config.outlets.direction = {1, 0, 0};
  config.outlets.flow = speed * depth * width;
  InflowTarget target;
  target.water = scene.water.get();
  target.domain = setup.domain;
  target.gravity = setup.gravity;
  const auto inflow = make_channel_inflow(config, target);

  std::vector<double> mass(place.size()), momentum(place.size());
  double looks = 0;
  for (int n = 0; scene.t < seconds; ++n) {
    inflow->advance(scene.t, scene.water->limits().step);
    scene.step();
    scene.water->remove_outside();
    if (scene.t < 0.5 * seconds || n % 10 != 0) continue;
    const WaterPoints p = scene.water->points();
    for (std::size_t i = 0; i < p.count(); ++i)
      for (std::size_t k = 0; k < place.size(); ++k) {
        if (std::abs(p.x[i].x() - place[k] * depth) > h) continue;
        mass[k] += p.mass[i];
        momentum[k] += p.mass[i] * p.v[i].x();
      }
    looks += 1;
  }
  Measured out;
  out.particle_steps = scene.point_steps;
  for (std::size_t k = 0; k < place.size(); ++k) {
    const double level = mass[k] / (looks * setup.config.fluid.density * 2 * h * width);
    out.values.push_back({fmt::format("depth over the first, {} depths on", place[k]), level / depth, 1, 1});
    out.values.push_back(
        {fmt::format("speed over the first, {} depths on", place[k]), momentum[k] / mass[k] / speed, 1, 1});
  }
  return out;
}

}  // namespace sluice
