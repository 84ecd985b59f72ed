#include "validation/rock_repose.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "base/random.h"
#include "validation/rock_scenes.h"

namespace sluice {

namespace {

constexpr double g = 9.81;
constexpr double degree = std::numbers::pi / 180;
constexpr double foot = 0.1, head = 0.8;  // of the base: the slope is measured between them

/// Slope of the line through the highest balls of cells two diameters wide, by least squares.
double slope_of(const Rocks& rocks, double cell, double length, double width) {
  const auto across = static_cast<std::size_t>(width / cell);
  const auto from = static_cast<std::size_t>((1 - head) * length / cell),
             to = static_cast<std::size_t>((1 - foot) * length / cell);
  std::vector<double> top(across * to, 0), place(across * to, 0);
  for (const Vec3& x : rocks.x) {
    if (!(x.x() > 0) || !(x.y() >= 0)) continue;
    const auto i = static_cast<std::size_t>(x.x() / cell), j = static_cast<std::size_t>(x.y() / cell);
    if (i >= to || j >= across || x.z() < top[i * across + j]) continue;
    top[i * across + j] = x.z();
    place[i * across + j] = x.x();
  }
  double n = 0, sum_x = 0, sum_z = 0, sum_xx = 0, sum_xz = 0;
  for (std::size_t k = from * across; k < to * across; ++k) {
    if (!(top[k] > 0)) continue;
    n += 1;
    sum_x += place[k];
    sum_z += top[k];
    sum_xx += place[k] * place[k];
    sum_xz += place[k] * top[k];
  }
  return (n * sum_xz - sum_x * sum_z) / (n * sum_xx - sum_x * sum_x);
}

}  // namespace

void RockRepose::keys(Schema& s) {
  s.number("base", base, {.at_least = 8, .doc = "length of the floor over the balls' diameter"});
  s.number("size", size, {.unit = "m", .above = 0, .doc = "diameter of the balls"});
  s.number("width", width, {.at_least = 6, .doc = "of the heap over the balls' diameter"});
  s.number("steepness", steepness, {.above = 0, .at_most = 80, .doc = "of the slope at the start [deg]"});
  s.integer("heaps", heaps, {.at_least = 1, .doc = "with balls placed anew, of which the mean is taken"});
  s.number("falls", falls, {.above = 0, .doc = "duration, in times to fall the length of the floor"});
}

double RockRepose::heap_angle(double friction, double rolling, std::int64_t seed, double& rock_steps) const {
  const double length = base * size, across = width * size;
  RockSetup setup;
  setup.pair = {0.3, friction, rolling};
  setup.smallest = 0.95 * size;
  setup.largest = 1.05 * size;
  setup.stiffness_per_size = 4e5;  // 5 % overlap at 0.4 m/s, as fast as balls roll here
  setup.gravity = {0, 0, -g};
  setup.box = {Vec3(-size, 0, -4 * size), Vec3(length + 4 * size, across, 3 * length)};
  setup.faces = {Face::open, Face::periodic, Face::open};
  Wall floor = level_wall(setup, 0), back = level_wall(setup, 0);
  floor.mesh = make_rectangle("floor", {Vec3(0, -across, 0), Vec3(length, -across, 0),
                                        Vec3(length, 2 * across, 0), Vec3(0, 2 * across, 0)});
  back.name = "back";
  back.mesh = make_rectangle("back", {Vec3(0, -across, 0), Vec3(0, 2 * across, 0),
                                      Vec3(0, 2 * across, 3 * length), Vec3(0, -across, 3 * length)});
  RockScene scene(setup, {floor, back});
  Random random(static_cast<std::uint64_t>(seed));
  const auto rows = static_cast<int>(across / (1.07 * size));
  const double cell = across / rows, slope = std::tan(steepness * degree);
  for (double z = 0.55 * size; z < slope * length; z += cell)
    for (double x = 0.56 * size; x + z / slope < length; x += cell)
      for (int j = 0; j < rows; ++j)
        scene.dem->add({.x = {x + 0.005 * size * random.uniform(-1, 1),
                              (j + 0.5) * cell + 0.005 * size * random.uniform(-1, 1), z},
                        .size = random.uniform(0.95, 1.05) * size});
  const double dt = scene.dem->step_size();
  const auto steps = static_cast<std::int64_t>(std::ceil(falls * std::sqrt(2 * length / g) / dt));
  for (std::int64_t n = 0; n < steps; ++n) {
    scene.step(dt);
    if (n % 100 == 0) scene.dem->remove_outside();
  }
  rock_steps += scene.rock_steps;
  return -std::atan(slope_of(scene.rocks(), 2 * size, length, across)) / degree;
}

Measured RockRepose::run(const CsvTable& reference) const {
  const std::vector<double> friction = reference_numbers(reference, "friction");
  const std::vector<double> rolling = reference_numbers(reference, "rolling");
  const std::vector<double> angle = reference_numbers(reference, "angle");
  Measured out;
  for (std::size_t k = 0; k < friction.size(); ++k) {
    double sum = 0;
    for (std::int64_t seed = 1; seed <= heaps; ++seed)
      sum += heap_angle(friction[k], rolling[k], seed, out.particle_steps);
    out.values.push_back(
        {fmt::format("angle of repose [deg], friction {}, rolling resistance {}", friction[k], rolling[k]),
         sum / static_cast<double>(heaps), angle[k], angle[k]});
  }
  return out;
}

}  // namespace sluice
