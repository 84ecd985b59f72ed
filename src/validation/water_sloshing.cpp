#include "validation/water_sloshing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "validation/water_scenes.h"

namespace sluice {

namespace {

constexpr double g = 9.81;

struct WaveSettings {
  double length = 0, depth = 0, omega = 0, cells = 0, amplitude = 0;
  double kinematic_viscosity = 1e-6, courant = 0.3;
};

/// A tank that starts level, with the wave's own velocity.
class StandingWave {
 public:
  explicit StandingWave(const WaveSettings& s) : k_(std::numbers::pi / s.length), depth_(s.depth) {
    const double h = s.length / s.cells, width = 4 * h, top = 1.5 * s.depth;
    WaterSetup setup;
    setup.config.spacing = h;
    setup.config.fastest_bulk_speed = 0.5;
    setup.config.deepest = s.depth;
    setup.config.courant = s.courant;
    setup.config.wall_slip = WallSlip::slip;
    setup.config.fluid.viscosity = s.kinematic_viscosity * setup.config.fluid.density;
    setup.gravity = {0, 0, -g};
    setup.domain = water_domain({Vec3(-h, 0, -h), Vec3(s.length + h, width, top)}, {false, true, false});
    scene_ = std::make_unique<WaterScene>(setup, trough(s.length, width, top, h));
    const double c = scene_->water->limits().sound_speed;
    WaterFill fill;
    fill.box = {Vec3::Zero(), Vec3(s.length, width, s.depth)};
    fill.velocity = [&](const Vec3& x) { return Vec3(s.amplitude * s.length * s.omega * mode(x)); };
    fill.pressure = [&](const Vec3& x) {
      return still_pressure(setup.config.fluid.density, g, c, s.depth - x.z());
    };
    scene_->fill(fill);
  }

  /// How much of the wave there is, in its own unit.
  double motion() const {
    const WaterPoints p = scene_->water->points();
    double sum = 0;
    for (std::size_t i = 0; i < p.count(); ++i) sum += p.mass[i] * p.v[i].dot(mode(p.x[i]));
    return sum;
  }
  WaterScene& scene() { return *scene_; }

 private:
  Vec3 mode(const Vec3& x) const {  // unit amplitude of the surface's speed
    return Vec3(-std::sin(k_ * x.x()) * std::cosh(k_ * x.z()), 0,
                std::cos(k_ * x.x()) * std::sinh(k_ * x.z())) /
           std::sinh(k_ * depth_);
  }

  double k_, depth_;
  std::unique_ptr<WaterScene> scene_;
};

WaveSettings wave_of(const CsvTable& reference) {
  WaveSettings s;
  s.length = reference_numbers(reference, "length").front();
  s.depth = reference_numbers(reference, "depth").front();
  s.omega = reference_numbers(reference, "omega").front();
  return s;
}

/// Slope of ln |extreme| over time, the first half period left out [1/s].
double decay_rate(StandingWave& wave, double omega, double periods) {
  WaterScene& scene = wave.scene();
  const double period = 2 * std::numbers::pi / omega;
  const double every = period / 100;
  std::vector<double> size{std::abs(wave.motion())}, time{0};
  while (scene.t < periods * period) {
    scene.run_to(every * static_cast<double>(size.size()));
    size.push_back(std::abs(wave.motion()));
    time.push_back(scene.t);
  }
  double n = 0, t1 = 0, t2 = 0, y1 = 0, ty = 0;
  for (std::size_t i = 20; i + 10 < size.size(); ++i) {
    const bool extreme = size[i] > size[i - 1] && size[i] >= size[i + 1];
    if (!extreme || size[i] < std::max(size[i - 10], size[i + 10])) continue;
    const double bend = size[i - 1] - 2 * size[i] + size[i + 1], tilt = (size[i + 1] - size[i - 1]) / 2;
    const double at = time[i] - tilt / bend * every, value = std::log(size[i] - tilt * tilt / (2 * bend));
    n += 1;
    t1 += at;
    t2 += at * at;
    y1 += value;
    ty += at * value;
  }
  if (n < 3)
    throw NumericalError("wave-decay", scene.t, "the wave did not swing often enough",
                         "raise 'periods' or 'amplitude'");
  return -(n * ty - t1 * y1) / (n * t2 - t1 * t1);
}

}  // namespace

void WaterSloshing::keys(Schema& s) {
  s.number("cells", cells, {.at_least = 8, .doc = "grid cells along the tank"});
  s.number("amplitude", amplitude, {.above = 0, .at_most = 0.1, .doc = "of the surface over the length"});
  s.number("periods", periods, {.at_least = 1, .doc = "over which the period is taken"});
}

Measured WaterSloshing::run(const CsvTable& reference) const {
  WaveSettings s = wave_of(reference);
  s.cells = cells;
  s.amplitude = amplitude;
  StandingWave wave(s);
  WaterScene& scene = wave.scene();
  const double period = 2 * std::numbers::pi / s.omega;
  const auto wanted = static_cast<std::size_t>(std::lround(2 * periods)) + 1;
  std::vector<double> crossings;
  double before = wave.motion(), before_t = 0;
  while (crossings.size() < wanted && scene.t < (periods + 2) * period) {
    for (int n = 0; n < 10; ++n) scene.step();
    const double now = wave.motion();
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
  out.values.push_back({"angular frequency [rad/s]", 2 * std::numbers::pi / measured, s.omega, s.omega});
  return out;
}

void WaterWaveDecay::keys(Schema& s) {
  s.number("cells", cells, {.at_least = 8, .doc = "grid cells along the tank"});
  s.number("amplitude", amplitude, {.above = 0, .at_most = 0.1, .doc = "of the surface over the length"});
  s.number("periods", periods, {.at_least = 2, .doc = "over which the decay is taken"});
  s.number("kinematic_viscosity", kinematic_viscosity, {.unit = "m^2/s", .above = 0, .doc = "of the liquid"});
  s.number("courant", courant, {.above = 0, .at_most = 0.3, .doc = "step, as for the water of a process"});
}

Measured WaterWaveDecay::run(const CsvTable& reference) const {
  WaveSettings s = wave_of(reference);
  s.cells = cells;
  s.amplitude = amplitude;
  s.kinematic_viscosity = kinematic_viscosity;
  const std::string quantity =
      reference_words(reference, "quantity", {"rate", "effective viscosity", "rise"}).front();
  const double value = reference_numbers(reference, "value").front();
  const double scale = reference_numbers(reference, "scale").front();
  Measured out;
  const auto rate_at = [&](double step) {
    s.courant = step;
    StandingWave wave(s);
    const double rate = decay_rate(wave, s.omega, periods);
    out.particle_steps += wave.scene().point_steps;
    return rate;
  };
  const double k = std::numbers::pi / s.length, rate = rate_at(courant);
  if (quantity == "rate") {
    out.values.push_back({"decay rate [1/s]", rate, value, scale});
  } else if (quantity == "effective viscosity") {
    out.values.push_back({"effective viscosity [m2/s]", rate / (2 * k * k), value, scale});
  } else {
    out.values.push_back({"effective viscosity at a third of the step, over that at it",
                          rate_at(courant / 3) / rate, value, scale});
  }
  return out;
}

}  // namespace sluice
