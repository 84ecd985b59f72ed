#include "validation/water_tilted.h"

#include <cmath>
#include <numbers>

#include "validation/water_scenes.h"

namespace sluice {

namespace {
constexpr double length = 0.5, depth = 0.25, top = 0.45, g = 9.81;

/// From rest to rest by half a wave.
WallMotion tilting(double angle, double seconds) {
  WallMotion motion;
  motion.kind = MotionKind::keyframes;
  motion.centre = {length / 2, 0, 0};
  constexpr int keys = 16;
  for (int k = -1; k <= keys + 1; ++k) {
    WallKeyframe key;
    key.time = seconds * k / keys;
    const double share = std::clamp(static_cast<double>(k) / keys, 0.0, 1.0);
    key.turn = {0, angle * 0.5 * (1 - std::cos(std::numbers::pi * share)), 0};
    motion.keyframes.push_back(key);
  }
  return motion;
}

Vec3 centroid_of(const FluidSystem& water) {
  const WaterPoints p = water.points();
  Vec3 moment = Vec3::Zero();
  double mass = 0;
  for (std::size_t i = 0; i < p.count(); ++i) {
    moment += p.mass[i] * p.x[i];
    mass += p.mass[i];
  }
  return moment / mass;
}
}  // namespace

void WaterTilted::keys(Schema& s) {
  s.number("cells", cells, {.at_least = 8, .doc = "grid cells along the tank"});
  s.number("angle", angle, {.unit = "rad", .above = 0, .at_most = 0.35, .doc = "by which the tank tilts"});
  s.number("seconds", seconds, {.unit = "s", .above = 0, .doc = "that the tilting takes"});
}

Measured WaterTilted::run(const CsvTable& reference) const {
  const std::vector<std::string> what = reference_words(reference, "what", {"along", "up", "work"});
  const std::vector<double> expected = reference_numbers(reference, "value");
  const WallMotion motion = tilting(angle, seconds);
  const double h = length / cells, width = 4 * h;
  WaterSetup setup;
  setup.config.spacing = h;
  setup.config.fastest_bulk_speed = 0.5;
  setup.config.deepest = depth;
  setup.config.wall_slip = WallSlip::slip;
  setup.gravity = {0, 0, -g};
  setup.domain =
      water_domain({Vec3(-0.15, 0, -0.15), Vec3(length + 0.2, width, top + 0.15)}, {false, true, false});
  std::vector<Wall> walls = trough(length, width, top, 0);
  for (Wall& wall : walls) wall.motion = motion;
  WaterScene scene(setup, std::move(walls));
  const double c = scene.water->limits().sound_speed;
  WaterFill fill;
  fill.box = {Vec3::Zero(), Vec3(length, width, depth)};
  fill.pressure = [&](const Vec3& x) {
    return still_pressure(setup.config.fluid.density, g, c, depth - x.z());
  };
  scene.fill(fill);
  const Vec3 before = centroid_of(*scene.water);
  scene.run_to(seconds);
  // What still swings does so about where it will stand: the mean over a period of the first wave.
  const double k = std::numbers::pi / length;
  const double period = 2 * std::numbers::pi / std::sqrt(g * k * std::tanh(k * depth));
  Vec3 sum = Vec3::Zero();
  constexpr int looks = 32;
  for (int n = 1; n <= looks; ++n) {
    scene.run_to(seconds + period * n / looks);
    sum += pose_at(motion, scene.t).to_rest(centroid_of(*scene.water));
  }
  const Vec3 shift = (sum / looks - before) / length;
  const double weight = g * scene.water->total_mass();
  const double work = (scene.water->wall_work() - scene.water->kinetic_energy()) / (weight * length);
  Measured out;
  for (std::size_t n = 0; n < what.size(); ++n) {
    const double measured = what[n] == "along" ? shift.x() : what[n] == "up" ? shift.z() : work;
    out.values.push_back({what[n], measured, expected[n], expected.front()});
  }
  out.particle_steps = scene.point_steps;
  return out;
}

}  // namespace sluice
