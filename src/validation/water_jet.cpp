#include "validation/water_jet.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "inflow/pipe_jet.h"
#include "validation/water_scenes.h"

namespace sluice {

void WaterJet::keys(Schema& s) {
  s.number("cells", cells, {.at_least = 2, .doc = "grid cells across the bore"});
  s.number("bore", bore, {.unit = "m", .above = 0, .doc = "of the pipe"});
  s.number("speed", speed, {.unit = "m/s", .above = 0, .doc = "at the pipe"});
  s.number("seconds", seconds, {.unit = "s", .above = 0, .doc = "how long it runs; the last third counts"});
}

Measured WaterJet::run(const CsvTable& reference) const {
  const std::vector<double> drop = reference_numbers(reference, "drop");
  const std::vector<double> fall = reference_numbers(reference, "speed");
  const std::vector<double> width = reference_numbers(reference, "width");
  const double h = bore / cells, deepest = drop.back() + 4 * h;
  WaterSetup setup;
  setup.config.spacing = h;
  setup.config.fastest_bulk_speed = fall.back();
  setup.gravity = {0, 0, -9.81};
  setup.domain = water_domain({Vec3(-2 * bore, -2 * bore, -deepest), Vec3(2 * bore, 2 * bore, 4 * h)},
                              {false, false, false});
  WaterScene scene(setup, {});
  PipeJetConfig config;
  config.name = "pipe";
  config.bore = bore;
  config.outlets.direction = {0, 0, -1};
  config.outlets.flow = speed * std::numbers::pi / 4 * bore * bore;
  InflowTarget target;
  target.water = scene.water.get();
  target.domain = setup.domain;
  target.gravity = setup.gravity;
  const auto pipe = make_pipe_jet(config, target);

  std::vector<double> mass(drop.size()), speed_sum(drop.size()), square(drop.size());
  for (int n = 0; scene.t < seconds; ++n) {
    pipe->advance(scene.t, scene.water->limits().step);
    scene.step();
    scene.water->remove_outside();
    if (scene.t < 2 * seconds / 3 || n % 10 != 0) continue;
    const WaterPoints p = scene.water->points();
    for (std::size_t i = 0; i < p.count(); ++i)
      for (std::size_t k = 0; k < drop.size(); ++k) {
        if (std::abs(-p.x[i].z() - drop[k]) > 0.5 * h) continue;
        mass[k] += p.mass[i];
        speed_sum[k] -= p.mass[i] * p.v[i].z();
        square[k] += p.mass[i] * (p.x[i].x() * p.x[i].x() + p.x[i].y() * p.x[i].y());
      }
  }
  Measured out;
  out.particle_steps = scene.point_steps;
  for (std::size_t k = 0; k < drop.size(); ++k) {
    const double radius = std::sqrt(2 * square[k] / mass[k]);  // of an even disc with this second moment
    out.values.push_back({fmt::format("speed {} m below, over the exact one", drop[k]),
                          speed_sum[k] / mass[k] / fall[k], 1, 1});
    out.values.push_back({fmt::format("d / d0 {} m below", drop[k]), 2 * radius / bore, width[k], 1});
  }
  return out;
}

}  // namespace sluice
