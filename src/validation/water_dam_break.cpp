#include "validation/water_dam_break.h"

#include <fmt/format.h>

#include <cmath>

#include "validation/water_scenes.h"

namespace sluice {

void WaterDamBreak::keys(Schema& s) {
  s.number("cells", cells, {.at_least = 4, .doc = "grid cells in the depth behind the dam"});
  s.number("time", time, {.above = 0, .doc = "when it is looked at, over sqrt(h0 / g)"});
  s.number("tail", tail, {.at_least = 0, .below = 1, .doc = "depth of the water ahead, over h0"});
}

Measured WaterDamBreak::run(const CsvTable& reference) const {
  const std::vector<double> place = reference_numbers(reference, "place");
  const std::vector<double> depth = reference_numbers(reference, "depth");
  constexpr double g = 9.81;  // h0 = 1 m
  const double h = 1 / cells, width = 4 * h;
  const double behind = std::ceil(time + 1),
               ahead = 2 * time + 2;  // no wave returns, the front stays on the floor
  WaterSetup setup;
  setup.config.spacing = h;
  setup.config.fastest_bulk_speed = 1;
  setup.config.deepest = 1;
  setup.config.wall_slip = WallSlip::slip;
  setup.gravity = {0, 0, -g};
  setup.domain = water_domain({Vec3(-behind - h, 0, -h), Vec3(ahead, width, 1.5)}, {false, true, false});
  std::vector<Wall> walls;
  walls.push_back(sheet("floor", {Vec3(-behind - h, -width, 0), Vec3(ahead + h, -width, 0),
                                  Vec3(ahead + h, 2 * width, 0), Vec3(-behind - h, 2 * width, 0)}));
  const double far = ahead - h;  // where water that lies ahead is held
  for (const double end : {-behind, far})
    if (end < 0 || tail > 0)
      walls.push_back(sheet("end", {Vec3(end, -width, -h), Vec3(end, 2 * width, -h),
                                    Vec3(end, 2 * width, 1.5), Vec3(end, -width, 1.5)}));
  WaterScene scene(setup, std::move(walls));
  const double c = scene.water->limits().sound_speed;
  WaterFill fill;
  fill.box = {Vec3(-behind, 0, 0), Vec3(0, width, 1)};
  fill.pressure = [&](const Vec3& x) { return still_pressure(setup.config.fluid.density, g, c, 1 - x.z()); };
  scene.fill(fill);
  if (tail > 0) {
    fill.box = {Vec3::Zero(), Vec3(far, width, tail)};
    fill.pressure = [&](const Vec3& x) {
      return still_pressure(setup.config.fluid.density, g, c, tail - x.z());
    };
    scene.fill(fill);
  }
  scene.run_to(time / std::sqrt(g));

  const double column = 2 * h;
  const auto columns = static_cast<std::size_t>((behind + ahead) / column) + 1;
  std::vector<double> x(columns), level(columns);
  for (std::size_t k = 0; k < columns; ++k) x[k] = -behind + (static_cast<double>(k) + 0.5) * column;
  const WaterPoints p = scene.water->points();
  for (std::size_t i = 0; i < p.count(); ++i) {
    const auto k = static_cast<std::size_t>(
        std::clamp((p.x[i].x() + behind) / column, 0.0, static_cast<double>(columns) - 1));
    level[k] += p.mass[i] / (setup.config.fluid.density * column * width);
  }
  Measured out;
  out.particle_steps = scene.point_steps;
  const double reach = scene.t * std::sqrt(g);
  for (std::size_t k = 0; k < place.size(); ++k)
    out.values.push_back({fmt::format("depth over h0 at x = {} t sqrt(g h0)", place[k]),
                          interpolated(x, level, place[k] * reach), depth[k], 1});
  return out;
}

}  // namespace sluice
