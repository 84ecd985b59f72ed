// Speed of the rocks. Each benchmark checks its answer and stops with an error if it is wrong.
#include <benchmark/benchmark.h>

#include <cmath>

#include "base/random.h"
#include "dem/dem_system.h"
#include "dem/rock_shape.h"
#include "dem/wall_contact.h"

namespace sluice {
namespace {

constexpr double size = 0.02;

DemScene bench_scene(const RockShape& shape) {
  DemScene scene;
  scene.materials.all = {{"rock", 2700}, {"steel", 0}};
  scene.materials.pairs.assign(4, {0.3, 0.5, 0});
  scene.shapes = {shape};
  scene.smallest_size = 0.9 * size;
  scene.largest_size = size;
  scene.densest = 2700;
  return scene;
}

/// A block of rocks pressed against their six neighbours, periodic on all sides, in slow motion.
void run_block(benchmark::State& state, const RockShape& shape, std::array<int, 3> n, double turn) {
  const Vec3 spacing = 0.99 * 2 * size * shape.semi_axes;
  DemScene scene = bench_scene(shape);
  scene.gravity.setZero();
  scene.domain.box = {Vec3::Zero(), spacing.cwiseProduct(Vec3(n[0], n[1], n[2]))};
  scene.domain.low.fill(Face::periodic);
  scene.domain.high.fill(Face::periodic);
  const Walls none;
  DemConfig config;
  config.overlap_limit = 1;
  DemSystem dem(config, scene, none);
  Random random(1);
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        dem.add(
            {.x = spacing.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5)) + 0.005 * size * random.on_sphere(),
             .v = 0.3 * random.on_sphere(),
             .q = Quat(Eigen::AngleAxisd(turn * random.uniform(), random.on_sphere())),
             .size = random.uniform(0.97, 1) * size});
  const double dt = dem.step_size();
  double t = 0;
  for (int k = 0; k < 3; ++k, t += dt) dem.step(t, dt);
  const Vec3 before = dem.momentum();
  for (auto _ : state) {
    dem.step(t, dt);
    t += dt;
  }
  const double rocks = static_cast<double>(dem.rocks().count());
  const double scale = rocks * dem.rocks().mass[0] * 0.3;
  if ((dem.momentum() - before).norm() > 1e-11 * scale) state.SkipWithError("momentum is not kept");
  if (static_cast<double>(dem.contact_count()) < 0.5 * rocks) state.SkipWithError("the block came apart");
  state.counters["rock_steps_per_s"] =
      benchmark::Counter(rocks * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["contacts_per_s"] =
      benchmark::Counter(static_cast<double>(dem.contact_count()) * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate);
}

/// A level floor of n x n squares through z = 0.
Walls bench_floor(double half_width, int n) {
  Wall wall;
  wall.name = "floor";
  wall.material = 1;
  wall.mesh.part_names = {"floor"};
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      wall.mesh.vertices.emplace_back(half_width * (2.0 * i / n - 1), half_width * (2.0 * j / n - 1), 0);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      wall.mesh.triangles.push_back({a, a + 1, a + n + 2});
      wall.mesh.triangles.push_back({a, a + n + 2, a + n + 1});
      wall.mesh.part.insert(wall.mesh.part.end(), {0, 0});
    }
  std::vector<Wall> all;
  all.push_back(std::move(wall));
  return Walls(std::move(all));
}

void dense_spheres(benchmark::State& state) {
  run_block(state, make_sphere(), {60, 60, 56}, 0);
}
BENCHMARK(dense_spheres)->Name("dem_spheres/dense_200k")->UseRealTime()->Unit(benchmark::kMillisecond);

void superquadrics_m4(benchmark::State& state) {
  run_block(state, make_superquadric(1.2, 0.8, 4), {31, 31, 31}, 0.1);
}
BENCHMARK(superquadrics_m4)->Name("dem_superquadrics/m4_30k")->UseRealTime()->Unit(benchmark::kMillisecond);

void spheres_on_walls(benchmark::State& state) {
  const Walls walls = bench_floor(1.3, 80);
  DemScene scene = bench_scene(make_sphere());
  scene.domain.box = {Vec3::Constant(-2), Vec3::Constant(2)};
  DemSystem dem({}, scene, walls);
  Random random(2);
  for (int j = 0; j < 100; ++j)
    for (int i = 0; i < 100; ++i)
      dem.add({.x = {0.022 * (i - 49.5), 0.022 * (j - 49.5), 0.5 * size - 1e-6},
               .v = Vec3(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0),
               .size = size});
  const double dt = dem.step_size();
  double t = 0;
  for (int k = 0; k < 3; ++k, t += dt) dem.step(t, dt);
  for (auto _ : state) {
    dem.step(t, dt);
    t += dt;
  }
  for (const Vec3& x : dem.rocks().x)
    if (std::abs(x.z() - 0.5 * size) > 0.05 * size) state.SkipWithError("a rock left the floor");
  state.counters["rock_steps_per_s"] =
      benchmark::Counter(1e4 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(spheres_on_walls)->Name("dem_spheres/walls_10k")->UseRealTime()->Unit(benchmark::kMillisecond);

void cached_walls(benchmark::State& state) {
  constexpr std::size_t count = 50000;
  const Walls walls = bench_floor(1, 100);
  const WallSurface surface(walls);
  Random random(3);
  std::vector<Vec3> x;
  std::vector<std::vector<int>> near(count);
  for (std::size_t i = 0; i < count; ++i) {
    x.emplace_back(random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9),
                   0.5 * size * random.uniform(0.9, 1.3));
    walls.query().triangles_in(Box{x[i], x[i]}.grown(0.65 * size), near[i]);
  }
  WallScratch scratch;
  std::size_t touching = 0;
  for (auto _ : state) {
    touching = 0;
    for (std::size_t i = 0; i < count; ++i) {
      find_sphere_contacts(surface, near[i], x[i], 0.5 * size, {}, scratch);
      touching += scratch.found.size();
    }
  }
  std::size_t expected = 0;
  for (const Vec3& place : x) expected += place.z() < 0.5 * size;
  if (touching != expected) state.SkipWithError("contacts differ from those with the plane");
  state.counters["queries_per_s"] = benchmark::Counter(
      static_cast<double>(count) * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(cached_walls)->Name("rock_walls/cached_50k")->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sluice
