/// Speed of the water step: a still box of a million points, with and without walls. Each run checks that
/// the water is still there, at rest and at its pressure.

#include <benchmark/benchmark.h>

#include <cmath>

#include "base/random.h"
#include "mpm/mpm_system.h"
#include "speed/speed.h"

namespace {

using namespace sluice;

constexpr double g = 9.81;
constexpr int cells = 50;  // 50^3 cells of 8 points
constexpr double h = 0.01;
constexpr double depth = cells * h;

enum class Scene { bare, walled };

Wall rectangle(const std::string& name, const std::array<Vec3, 4>& corners) {
  Wall wall;
  wall.name = name;
  wall.mesh = make_rectangle(name, corners);
  return wall;
}

Walls box_walls() {
  const double a = -0.05, b = depth + 0.05;
  std::vector<Wall> walls;
  walls.push_back(rectangle("floor", {Vec3(a, a, 0), Vec3(b, a, 0), Vec3(b, b, 0), Vec3(a, b, 0)}));
  walls.push_back(rectangle("left", {Vec3(0, a, a), Vec3(0, b, a), Vec3(0, b, b), Vec3(0, a, b)}));
  walls.push_back(
      rectangle("right", {Vec3(depth, a, a), Vec3(depth, b, a), Vec3(depth, b, b), Vec3(depth, a, b)}));
  walls.push_back(rectangle("front", {Vec3(a, 0, a), Vec3(b, 0, a), Vec3(b, 0, b), Vec3(a, 0, b)}));
  walls.push_back(
      rectangle("back", {Vec3(a, depth, a), Vec3(b, depth, a), Vec3(b, depth, b), Vec3(a, depth, b)}));
  return Walls(std::move(walls));
}

void water_steps(benchmark::State& state, Scene scene, Precision precision) {
  const Walls walls = scene == Scene::walled ? box_walls() : Walls();
  Domain domain;
  domain.box.lo = scene == Scene::walled ? Vec3(-0.05, -0.05, -0.05) : Vec3(0, 0, 0);
  domain.box.hi =
      scene == Scene::walled ? Vec3(depth + 0.05, depth + 0.05, depth + 0.1) : Vec3(depth, depth, depth);
  if (scene == Scene::bare) domain.low = domain.high = {Face::periodic, Face::periodic, Face::periodic};
  const Vec3 gravity = scene == Scene::walled ? Vec3(0, 0, -g) : Vec3(0, 0, 0);
  MpmConfig config;
  config.spacing = h;
  config.deepest = depth;
  config.fastest_bulk_speed = 3;
  config.precision = precision;
  const auto water = make_mpm(config, domain, gravity, walls);
  const double c = water->limits().sound_speed;
  Random random(1);
  const int n = 2 * cells;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        NewPoint p;
        for (int r = 0; r < 3; ++r)
          p.x[r] = 0.5 * h * ((r == 0 ? i : r == 1 ? j : k) + 0.5 + 0.2 * random.uniform(-1.0, 1.0));
        if (scene == Scene::walled) p.J = 1 / (1 + g * (depth - p.x.z()) / (c * c));
        p.mass = 1000 * std::pow(0.5 * h, 3) / p.J;
        if (scene == Scene::bare) p.v = Vec3(0.5, 0.3, 0.2);
        water->add(p);
      }
  const double dt = water->limits().step;
  double t = 0;
  const auto step = [&] {
    water->points_to_grid(t, dt);
    water->walls(dt);
    water->grid_to_points(dt);
    t += dt;
  };
  step();
  const double mass = water->total_mass();
  const Vec3 momentum = water->momentum();
  const double seconds = speed::time_steps(state, step);
  const double moved = (water->momentum() - momentum).norm() / mass;
  if (water->total_mass() != mass || !(moved < (scene == Scene::walled ? 0.05 : 1e-5)) ||
      !(water->largest_speed() < 2))
    state.SkipWithError("the water did not stay as it should");
  const double points = static_cast<double>(water->count());
  state.counters["point_steps_per_s"] = speed::rate(state, points, seconds);
  state.counters["bytes_per_point"] = static_cast<double>(water->memory_bytes()) / points;
}

BENCHMARK_CAPTURE(water_steps, box_1m, Scene::walled, Precision::single)
    ->Name("mpm_water/box_1m")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(water_steps, bare_1m, Scene::bare, Precision::single)
    ->Name("mpm_water/bare_1m")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(water_steps, box_1m_double, Scene::walled, Precision::reference)
    ->Name("mpm_water/box_1m_double")
    ->Unit(benchmark::kMillisecond);

}  // namespace
