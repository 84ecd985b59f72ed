#include "validation/coupling_dam.h"

#include <algorithm>
#include <cmath>

#include "validation/coupling_scenes.h"

namespace sluice {

namespace {
constexpr double height = 0.3, length = 0.9, top = 1, g = 9.81;  // [m], [m/s2]
constexpr double rock = 0.02, edge = 0.09;                       // [m]
}  // namespace

void CouplingDam::keys(Schema& s) {
  s.number("cells", cells, {.at_least = 8, .doc = "of the grid over the column's height"});
  s.number("seconds", seconds, {.unit = "s", .above = 0, .doc = "that are run"});
  s.flag("cube", cube, {.doc = "a resolved cube of 90 mm instead of the heap"});
}

Measured CouplingDam::run(const CsvTable& reference) const {
  const double h = height / cells, width = cube ? 0.36 : 0.12, size = cube ? edge : rock;
  ImmersedSetup setup;
  setup.rock_size = size;
  if (cube) {
    setup.rock_shape = make_superquadric(1, 1, 8);
    setup.coupling.resolve_from = setup.coupling.resolve_partly_from = 2.5;
  }
  setup.water.config.spacing = h;
  setup.water.config.fastest_bulk_speed = 2 * std::sqrt(g * height);
  setup.water.config.deepest = height;
  setup.water.gravity = {0, 0, -g};
  setup.water.domain = water_domain({Vec3(-h, 0, -h), Vec3(length + h, width, top)}, {false, true, false});
  ImmersedScene scene(setup, trough(length, width, top, h));
  const double c = scene.fluid.water->limits().sound_speed;
  WaterFill fill;
  fill.box = {Vec3::Zero(), Vec3(height, width, height)};
  fill.pressure = [&](const Vec3& x) {
    return still_pressure(setup.water.config.fluid.density, g, c, height - x.z());
  };
  scene.fluid.fill(fill);
  if (cube) scene.rocks->add({.x = {0.5, 0.5 * width, 0.5 * size}, .size = size});
  for (int layer = 0; !cube && layer < 3; ++layer)
    for (int row = 0; row < 10; ++row)
      for (int across = 0; across < 6; ++across)
        scene.rocks->add(
            {.x = {0.5 + 1.05 * size * row, size * (0.5 + across), size * (0.5 + layer)}, .size = size});
  const auto rock_mass = [&] {
    double sum = 0;
    for (const double m : scene.rocks->rocks().mass) sum += m;
    return sum;
  };
  const double water_before = scene.fluid.water->total_mass(), rocks_before = rock_mass();
  double peak = 0, largest_mean = 0, window = 0, looks = 0, window_end = 0.01;
  while (scene.fluid.t < seconds) {
    scene.step();
    Vec3 force = Vec3::Zero();
    for (std::size_t r = 0; r < scene.rocks->rocks().count(); ++r) force += scene.coupling->force()[r];
    peak = std::max(peak, force.norm());
    window += force.norm();
    looks += 1;
    if (scene.fluid.t < window_end) continue;
    largest_mean = std::max(largest_mean, window / looks);
    window = looks = 0;
    window_end += 0.01;
  }
  Measured out;
  const std::vector<std::string> what =
      reference_words(reference, "what", {"peak", "water", "rocks", "momentum"});
  const std::vector<double> expected = reference_numbers(reference, "value");
  const std::vector<double> scale = reference_numbers(reference, "scale");
  const Vec3 both = scene.coupling->impulse_on_rocks() + scene.coupling->impulse_on_fluid();
  for (std::size_t n = 0; n < what.size(); ++n) {
    double measured = both.norm() / scene.exchanged;
    if (what[n] == "peak") measured = peak / largest_mean;
    if (what[n] == "water") measured = scene.fluid.water->total_mass() / water_before;
    if (what[n] == "rocks") measured = rock_mass() / rocks_before;
    out.values.push_back({what[n], measured, expected[n], scale[n]});
  }
  out.particle_steps = scene.fluid.point_steps;
  return out;
}

}  // namespace sluice
