#include "validation/water_still.h"

#include <fmt/format.h>

#include <cmath>

#include "validation/water_scenes.h"

namespace sluice {

void WaterStill::keys(Schema& s) {
  s.number("cells", cells, {.at_least = 4, .doc = "grid cells in the depth"});
  s.number("depth", depth, {.unit = "m", .above = 0, .doc = "of the water"});
  s.number("seconds", seconds, {.unit = "s", .above = 1, .doc = "how long it runs; the last second counts"});
  s.number("jitter", jitter, {.at_least = 0, .at_most = 0.5, .doc = "of the points, over their distance"});
  s.choice("precision", precision, {{"single", Precision::single}, {"reference", Precision::reference}},
           {.doc = "single or reference"});
  s.number("sound_factor", sound_factor,
           {.above = 0, .doc = "over the sound speed of the reference; other than 1 is a fault"});
}

Measured WaterStill::run(const CsvTable& reference) const {
  const std::vector<double> z = reference_numbers(reference, "z");
  const std::vector<double> expected = reference_numbers(reference, "pressure");
  constexpr double g = 9.81;
  const double h = depth / cells, width = 4 * h;
  WaterSetup setup;
  setup.config.spacing = h;
  setup.config.fastest_bulk_speed = 0.1;
  setup.config.deepest = depth;
  setup.config.sound_speed = sound_factor * 10 * std::sqrt(2 * g * depth);
  setup.config.precision = precision;
  setup.gravity = {0, 0, -g};
  setup.domain = water_domain({Vec3(0, 0, -h), Vec3(width, width, depth + 4 * h)}, {true, true, false});
  WaterScene scene(setup, {sheet("floor", {Vec3(-width, -width, 0), Vec3(2 * width, -width, 0),
                                           Vec3(2 * width, 2 * width, 0), Vec3(-width, 2 * width, 0)})});
  const double c = scene.water->limits().sound_speed;
  WaterFill fill;
  fill.box = {Vec3::Zero(), Vec3(width, width, depth)};
  fill.jitter = jitter;
  fill.pressure = [&](const Vec3& x) {
    return still_pressure(setup.config.fluid.density, g, c, depth - x.z());
  };
  scene.fill(fill);

  // mean over nodes of a level and over time
  const auto levels = static_cast<std::size_t>(cells) + 1;
  std::vector<double> sum(levels), count(levels), height(levels);
  for (std::size_t k = 0; k < levels; ++k) height[k] = h * static_cast<double>(k);
  FluidNodes nodes;
  const auto look = [&] {
    scene.water->read_nodes(nodes);
    for (std::size_t n = 0; n < nodes.count(); ++n) {
      const double level = nodes.x[n].z() / h;
      if (level < -0.5 || level > static_cast<double>(levels) - 0.5) continue;
      const auto k = static_cast<std::size_t>(std::lround(level));
      sum[k] += nodes.pressure[n];
      count[k] += 1;
    }
  };
  scene.run_to(seconds - 1);
  for (int n = 0; scene.t < seconds; ++n)
    if (n % 20 == 0)
      scene.step(look);
    else
      scene.step();
  std::vector<double> mean(levels);
  for (std::size_t k = 0; k < levels; ++k) mean[k] = sum[k] / count[k];
  Measured out;
  out.particle_steps = scene.point_steps;
  for (std::size_t k = 0; k < z.size(); ++k)
    out.values.push_back({fmt::format("pressure at z = {} m [Pa]", z[k]), interpolated(height, mean, z[k]),
                          expected[k], expected[k]});
  return out;
}

}  // namespace sluice
