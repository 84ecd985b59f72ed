#include "validation/coupling_heave.h"

#include <cmath>
#include <limits>

#include "validation/coupling_scenes.h"

namespace sluice {

namespace {

constexpr double g = 9.81;
constexpr double wide = 5, deep = 2;  // of the tank, over the body's height

/// A body in a tank, where it would float if the water's level followed it at once.
class FloatingBody {
 public:
  /// @param height  of the body [m];  @param under  share of its height that is under water when it floats
  FloatingBody(const RockShape& shape, double height, double cells, double density, double under)
      : height_(height), h_(height / cells), scene_(setup(shape, height, h_, density), tank(height)) {
    level_ = deep * height;
    const double c = scene_.fluid.water->limits().sound_speed;
    WaterFill fill;
    fill.box = {Vec3::Zero(), Vec3(wide * height, wide * height, level_)};
    fill.pressure = [&](const Vec3& x) { return still_pressure(1000, g, c, level_ - x.z()); };
    scene_.fluid.fill(fill);
    floats_at_ = level_ + (0.5 - under) * height;
  }

  void put(double above) {
    const double size = height_ / (2 * scene_.rocks->shapes()[0].semi_axes.z());
    scene_.rocks->add({.x = {0.5 * wide * height_, 0.5 * wide * height_, floats_at_ + above}, .size = size});
    double removed = 0;
    for (const RemovedPoint& p : scene_.coupling->make_room()) removed += p.mass / 1000;
    const double mass = scene_.rocks->rocks().mass[0] / 1000;
    floats_at_ += (mass - removed) / std::pow(wide * height_, 2);  // once the level has followed
  }
  /// Above where it floats [m].
  double above() const { return scene_.rocks->rocks().x[0].z() - floats_at_; }
  void step() { scene_.step(); }
  double time() const { return scene_.fluid.t; }
  double point_steps() const { return scene_.fluid.point_steps; }

 private:
  static ImmersedSetup setup(const RockShape& shape, double height, double h, double density) {
    ImmersedSetup setup;
    setup.rock_shape = shape;
    setup.rock_density = density;
    setup.rock_size = height / (2 * shape.semi_axes.z());
    setup.coupling.resolve_from = 3;
    setup.coupling.resolve_partly_from = 3;
    setup.water.config.spacing = h;
    setup.water.config.fastest_bulk_speed = 1;
    setup.water.config.deepest = deep * height;
    setup.water.gravity = {0, 0, -g};
    const Box tank{Vec3::Zero(), Vec3(wide * height, wide * height, (deep + 1.5) * height)};
    setup.water.domain = water_domain(tank.grown(h), {false, false, false});
    return setup;
  }
  static std::vector<Wall> tank(double height) {
    Wall wall;
    wall.name = "tank";
    wall.mesh = make_box("tank", {Vec3::Zero(), Vec3(wide * height, wide * height, (deep + 1.5) * height)});
    return {wall};
  }

  double height_, h_, level_ = 0, floats_at_ = 0;
  ImmersedScene scene_;
};

/// Time between the first and the third pass through where it floats [s]; NaN where it does not come to it.
double period(FloatingBody& body, double size) {
  body.put(0.1 * size);
  std::vector<double> passes;
  double before = body.above(), at = 0;
  while (passes.size() < 3 && body.time() < 5 * std::sqrt(size)) {
    body.step();
    const double now = body.above();
    if (before * now < 0) passes.push_back(at + before / (before - now) * (body.time() - at));
    before = now;
    at = body.time();
  }
  return passes.size() == 3 ? passes[2] - passes[0] : std::numeric_limits<double>::quiet_NaN();
}

/// Mean height over where it floats in the second half of the time [m].
double mean_above(FloatingBody& body, double seconds) {
  body.put(0);
  double sum = 0, count = 0;
  while (body.time() < seconds) {
    body.step();
    if (body.time() < 0.5 * seconds) continue;
    sum += body.above();
    count += 1;
  }
  return sum / count;
}

}  // namespace

void CouplingHeave::keys(Schema& s) {
  s.number("size_cells", size_cells,
           {.at_least = 3, .at_most = 40, .doc = "height of the body over the spacing"});
  s.number("size", size, {.unit = "m", .above = 0, .doc = "height of the body"});
  s.number("seconds", seconds, {.unit = "s", .above = 0, .doc = "that are run for the draft"});
}

Measured CouplingHeave::run(const CsvTable& reference) const {
  Measured out;
  const std::vector<std::string> what =
      reference_words(reference, "what", {"sphere_period", "sphere_draft", "box_draft"});
  const std::vector<double> expected = reference_numbers(reference, "value");
  const std::vector<double> scale = reference_numbers(reference, "scale");
  for (std::size_t n = 0; n < what.size(); ++n) {
    const bool box = what[n] == "box_draft";
    const double under = what[n] == "sphere_period" ? 0.5 : expected[n];
    const RockShape shape = box ? make_superquadric(1, 2.0 / 3, 16) : make_sphere();
    const double density = 1000 * (box ? 0.6 : 0.5);
    FloatingBody body(shape, size, size_cells, density, under);
    const double measured =
        what[n] == "sphere_period" ? period(body, size) : under - mean_above(body, seconds) / size;
    out.particle_steps += body.point_steps();
    out.values.push_back({what[n], measured, expected[n], scale[n]});
  }
  return out;
}

}  // namespace sluice
