#include "validation/emitter_flux.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "validation/water_scenes.h"

namespace sluice {

namespace {

constexpr double below = 0.3;        // plane of the reference [m]
constexpr double half_width = 0.05;  // of the bins, over the edge's distance

/// Distances from the axis at which the points of one nozzle meet the plane [m].
std::vector<double> landings(SprayPattern pattern, double angle, std::int64_t points) {
  WaterSetup setup;
  setup.config.spacing = 0.02;
  setup.domain = water_domain({Vec3::Constant(-1), Vec3::Constant(1)}, {false, false, false});
  WaterScene scene(setup, {});
  SprayNozzleConfig config;
  config.name = "nozzle";
  config.pattern = pattern;
  config.angle = angle;
  config.thickness = 0;
  config.rated_flow = 2e-3;
  config.rated_pressure = 2e5;
  config.pressure = 2e5;
  config.outlets.direction = {0, 0, -1};
  InflowTarget target;
  target.water = scene.water.get();
  target.domain = setup.domain;
  const auto nozzle = make_spray_nozzle(config, target);
  const double point_mass = scene.water->point_volume() * scene.water->model().density;
  const double dt = 10 * point_mass / 2;  // ten points a step of 2 kg/s
  for (int n = 0; static_cast<std::int64_t>(scene.water->count()) < points; ++n) nozzle->advance(n * dt, dt);
  std::vector<double> r;
  for (const Vec3& v : scene.water->points().v) r.push_back(below * std::hypot(v.x(), v.y()) / -v.z());
  return r;
}

}  // namespace

void EmitterFlux::keys(Schema& s) {
  s.integer("points", points, {.at_least = 10, .doc = "water points that leave the nozzle"});
  s.choice("pattern", pattern, {{"flat_fan", SprayPattern::flat_fan}, {"full_cone", SprayPattern::full_cone}},
           {.doc = "of the spray"});
}

Measured EmitterFlux::run(const CsvTable& reference) const {
  const std::vector<double> angle = reference_numbers(reference, "angle");
  const std::vector<double> place = reference_numbers(reference, "place");
  const std::vector<double> flux = reference_numbers(reference, "flux");
  Measured out;
  std::vector<double> r;
  for (std::size_t k = 0; k < angle.size(); ++k) {
    const double full = angle[k] * std::numbers::pi / 180, edge = below * std::tan(0.5 * full);
    if (k == 0 || angle[k] != angle[k - 1]) {
      r = landings(pattern, full, points);
      out.particle_steps += static_cast<double>(r.size());
    }
    const double from = (place[k] - half_width) * edge, to = (place[k] + half_width) * edge;
    double inside = 0;
    for (const double at : r) inside += at >= from && at < to ? 1 : 0;
    // A fan lands on both sides of its axis.
    const double space =
        pattern == SprayPattern::flat_fan ? 2 * (to - from) : std::numbers::pi * (to * to - from * from);
    out.values.push_back({fmt::format("flux at {} of the edge, {} degrees", place[k], angle[k]),
                          inside / static_cast<double>(r.size()) / space, flux[k], flux[k]});
  }
  return out;
}

}  // namespace sluice
