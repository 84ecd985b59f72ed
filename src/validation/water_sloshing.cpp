#include "validation/water_sloshing.h"

#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "validation/water_scenes.h"

namespace sluice {

void WaterSloshing::keys(Schema& s) {
  s.number("cells", cells, {.at_least = 8, .doc = "grid cells along the tank"});
  s.number("amplitude", amplitude, {.above = 0, .at_most = 0.1, .doc = "of the surface over the length"});
  s.number("periods", periods, {.at_least = 1, .doc = "over which the period is taken"});
}

Measured WaterSloshing::run(const CsvTable& reference) const {
  const double length = reference_numbers(reference, "length").front();
  const double depth = reference_numbers(reference, "depth").front();
  const double omega = reference_numbers(reference, "omega").front();
  constexpr double g = 9.81;
  const double h = length / cells, width = 4 * h, k = std::numbers::pi / length, top = 1.5 * depth;
  WaterSetup setup;
  setup.config.spacing = h;
  setup.config.fastest_bulk_speed = 0.5;
  setup.config.deepest = depth;
  setup.config.wall_slip = WallSlip::slip;
  setup.gravity = {0, 0, -g};
  setup.domain = water_domain({Vec3(-h, 0, -h), Vec3(length + h, width, top)}, {false, true, false});
  WaterScene scene(setup, trough(length, width, top, h));
  const double c = scene.water->limits().sound_speed;
  const auto mode = [&](const Vec3& x) -> Vec3 {  // unit amplitude of the surface's speed
    return Vec3(-std::sin(k * x.x()) * std::cosh(k * x.z()), 0, std::cos(k * x.x()) * std::sinh(k * x.z())) /
           std::sinh(k * depth);
  };
  WaterFill fill;
  fill.box = {Vec3::Zero(), Vec3(length, width, depth)};
  fill.velocity = [&](const Vec3& x) { return Vec3(amplitude * length * omega * mode(x)); };
  fill.pressure = [&](const Vec3& x) {
    return still_pressure(setup.config.fluid.density, g, c, depth - x.z());
  };
  scene.fill(fill);
  const auto project = [&] {
    const WaterPoints p = scene.water->points();
    double sum = 0;
    for (std::size_t i = 0; i < p.count(); ++i) sum += p.mass[i] * p.v[i].dot(mode(p.x[i]));
    return sum;
  };
  const double period = 2 * std::numbers::pi / omega;
  const auto wanted = static_cast<std::size_t>(std::lround(2 * periods)) + 1;
  std::vector<double> crossings;
  double before = project(), before_t = 0;
  while (crossings.size() < wanted && scene.t < (periods + 2) * period) {
    for (int n = 0; n < 10; ++n) scene.step();
    const double now = project();
    if (before * now < 0) crossings.push_back(before_t + (scene.t - before_t) * before / (before - now));
    before = now;
    before_t = scene.t;
  }
  if (crossings.size() < wanted)
    throw NumericalError("sloshing", scene.t, "the wave did not swing often enough",
                         "raise 'cells' or 'amplitude'");
  const double measured =
      2 * (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  Measured out;
  out.particle_steps = scene.point_steps;
  out.values.push_back({"angular frequency [rad/s]", 2 * std::numbers::pi / measured, omega, omega});
  return out;
}

}  // namespace sluice
