#include "validation/water_plate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "inflow/pipe_jet.h"
#include "validation/water_scenes.h"

namespace sluice {

void WaterPlate::keys(Schema& s) {
  s.number("cells", cells, {.at_least = 2, .doc = "grid cells across the bore"});
  s.number("bore", bore, {.unit = "m", .above = 0, .doc = "of the jet"});
  s.number("speed", speed, {.unit = "m/s", .above = 0, .doc = "of the jet"});
  s.number("angle", angle, {.unit = "rad", .above = 0, .at_most = 1.6, .doc = "between jet and plate"});
  s.number("passes", passes, {.above = 0, .doc = "bores that the jet runs; the last half is read"});
}

namespace {

struct Impact {
  double force = 0;       ///< across the plate, over rho V^2 A
  double forward = 0;     ///< share of what left
  double stagnation = 0;  ///< pressure over rho V^2 / 2
  double point_steps = 0;
};

/// The jet falls along z, the plate is turned about y.
Impact impact(const WaterPlate& c, double bulk_speed) {
  const double d = c.bore, h = d / c.cells, half = 3 * d;
  const Vec3 along(std::sin(c.angle), 0, -std::cos(c.angle));  // the way the jet points
  const Vec3 normal(std::cos(c.angle), 0, std::sin(c.angle));
  // Not with the plate on nodes.
  const Vec3 middle = -0.37 * h * normal;
  WaterSetup setup;
  setup.config.spacing = h;
  setup.config.fastest_bulk_speed = bulk_speed;
  setup.config.wall_slip = WallSlip::slip;
  const double side = 2.9 * d;
  setup.domain = water_domain({Vec3(-side, -side, -side), Vec3(side, side, side)}, {false, false, false});
  const Vec3 across(0, 1, 0);
  const auto corner = [&](double a, double b) {
    return Vec3(middle + a * 2 * half * along + b * half * across);
  };
  WaterScene scene(setup, {sheet("plate", {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)})});
  PipeJetConfig config;
  config.name = "pipe";
  config.bore = d;
  config.outlets.position = {0, 0, 2 * d};
  config.outlets.direction = {0, 0, -1};
  config.outlets.flow = c.speed * std::numbers::pi / 4 * d * d;
  InflowTarget target;
  target.water = scene.water.get();
  target.domain = setup.domain;
  const auto pipe = make_pipe_jet(config, target);

  const double until = c.passes * d / c.speed, density = setup.config.fluid.density;
  double begun = 0, impulse = 0, left = 0, forward = 0;
  // Pressure beside the plate, by place along it.
  const double patch = 0.25 * d;
  std::vector<double> pressure(16), weight(16);
  const auto on_plate = [&] { return -scene.water->wall_loads()[0].impulse.dot(normal); };
  for (int n = 0; scene.t < until; ++n) {
    pipe->advance(scene.t, scene.water->limits().step);
    scene.step();
    const bool counts = scene.t > 0.5 * until;
    for (const RemovedPoint& p : scene.water->remove_outside())
      if (counts) {
        left += p.mass;
        forward += p.v.dot(along) > 0 ? p.mass : 0;
      }
    if (!counts) continue;
    if (begun == 0) {
      begun = scene.t;
      impulse = on_plate();
    }
    if (n % 10 != 0) continue;
    const WaterPoints p = scene.water->points();
    for (std::size_t i = 0; i < p.count(); ++i) {
      const Vec3 x = p.x[i] - middle;
      const double above = x.dot(normal);
      const double place = x.dot(along) / patch + 8;
      if (above > h || std::abs(x.y()) > 0.5 * patch || place < 0 || place >= 16) continue;
      const auto k = static_cast<std::size_t>(place);
      pressure[k] += p.mass[i] * p.pressure[i];
      weight[k] += p.mass[i];
    }
  }
  const double area = std::numbers::pi / 4 * d * d, v2 = c.speed * c.speed;
  Impact found;
  found.force = (on_plate() - impulse) / (scene.t - begun) / (density * v2 * area);
  found.forward = forward / left;
  for (std::size_t k = 0; k < weight.size(); ++k)
    if (weight[k] > 0)
      found.stagnation = std::max(found.stagnation, pressure[k] / weight[k] / (0.5 * density * v2));
  found.point_steps = scene.point_steps;
  return found;
}

}  // namespace

Measured WaterPlate::run(const CsvTable& reference) const {
  const std::vector<std::string> quantity =
      reference_words(reference, "quantity", {"force", "forward", "stagnation", "sound"});
  const std::vector<double> value = reference_numbers(reference, "value");
  const std::vector<double> scale = reference_numbers(reference, "scale");
  const Impact plain = impact(*this, speed);
  Measured out;
  out.particle_steps = plain.point_steps;
  for (std::size_t k = 0; k < value.size(); ++k) {
    double measured = 0;
    if (quantity[k] == "force") measured = plain.force;
    if (quantity[k] == "forward") measured = plain.forward;
    if (quantity[k] == "stagnation") measured = plain.stagnation;
    if (quantity[k] == "sound") {
      const Impact faster = impact(*this, 2 * speed);
      out.particle_steps += faster.point_steps;
      measured = faster.force / plain.force;
    }
    out.values.push_back({quantity[k], measured, value[k], scale[k]});
  }
  return out;
}

}  // namespace sluice
