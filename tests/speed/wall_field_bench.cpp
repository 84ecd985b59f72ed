// What the walls cost a water point, and their set-up at the scale of a feed box.
//
//   wall_field/full      one sheet across the stencil: points_per_s of visibility()
//   wall_field/partial   near the lip of a ledge above a floor: one patch that covers, one that ends
//   wall_field/planes    planes_of_point() at one sheet
//   wall_field/path      first_hit() of a path of a tenth of a cell
//   wall_field/set_up    a box with ledges, 50 m2 of walls, h = 40 mm

#include <benchmark/benchmark.h>

#include <bit>
#include <vector>

#include "base/random.h"
#include "mpm/wall_field.h"

namespace sluice {
namespace {

constexpr double h = 0.04;

Wall rectangle(const Vec3& corner, const Vec3& a, const Vec3& b) {
  Wall wall;
  wall.mesh = make_rectangle("sheet", {corner, corner + a, corner + a + b, corner + b});
  return wall;
}

Domain domain_of(const Box& box) {
  Domain domain;
  domain.box = box;
  return domain;
}

struct Probes {
  std::vector<Vec3> x;
  std::vector<Vec3i> base;
};

/// Places in the cell whose lowest stencil node is `base`.
Probes places_in(const Vec3i& base, int count) {
  Random random(7);
  Probes probes;
  for (int i = 0; i < count; ++i) {
    probes.base.push_back(base);
    Vec3 u;
    for (int k = 0; k < 3; ++k) u[k] = base[k] + random.uniform(0.5, 1.5);
    probes.x.push_back(h * u);
  }
  return probes;
}

/// Hidden nodes over all places, the same by the path check and by visibility().
bool agrees(const WallField& field, const Probes& probes) {
  for (std::size_t i = 0; i < probes.x.size(); ++i) {
    Visibility v;
    field.visibility(field.stencil(probes.base[i]), probes.base[i], probes.x[i], v);
    for (int n = 0; n < 27; ++n) {
      const Vec3 node = (probes.base[i] + Vec3i(n % 3, n / 3 % 3, n / 9)).cast<double>() + node_offset;
      if ((v.hidden >> n & 1) != (field.first_hit(-1, probes.x[i], h * node) ? 1u : 0u)) return false;
    }
  }
  return true;
}

void time_visibility(benchmark::State& state, const WallField& field, const Vec3i& base) {
  const Probes probes = places_in(base, 1000);
  if (!agrees(field, probes)) state.SkipWithError("visibility and path disagree");
  const int stencil = field.stencil(base);
  Visibility v;
  int hidden = 0;
  for (auto _ : state) {
    hidden = 0;
    for (std::size_t i = 0; i < probes.x.size(); ++i) {
      field.visibility(stencil, base, probes.x[i], v);
      hidden += std::popcount(v.hidden);
      benchmark::DoNotOptimize(v);
    }
  }
  if (hidden == 0) state.SkipWithError("nothing hidden");
  state.counters["points_per_s"] =
      benchmark::Counter(1000.0 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

/// A floor from z = 0.31 h, and a ledge 0.9 h above it that ends at x = 10.2 h.
Walls floor_and_ledge() {
  std::vector<Wall> walls;
  walls.push_back(rectangle(h * Vec3(-20, -20, 5.31), h * Vec3(60, 0, 0), h * Vec3(0, 60, 0)));
  walls.push_back(rectangle(h * Vec3(-20, -20, 6.21), h * Vec3(30.2, 0, 0), h * Vec3(0, 60, 0)));
  return Walls(std::move(walls));
}

void full(benchmark::State& state) {
  const Walls walls = floor_and_ledge();
  const WallField field(walls, domain_of({h * Vec3(-10, -10, 0), h * Vec3(30, 30, 12)}), Vec3::Zero(), h);
  time_visibility(state, field, {20, 10, 4});
}
BENCHMARK(full)->Name("wall_field/full");

void partial(benchmark::State& state) {
  const Walls walls = floor_and_ledge();
  const WallField field(walls, domain_of({h * Vec3(-10, -10, 0), h * Vec3(30, 30, 12)}), Vec3::Zero(), h);
  time_visibility(state, field, {9, 10, 5});
}
BENCHMARK(partial)->Name("wall_field/partial");

void planes(benchmark::State& state) {
  const Walls walls = floor_and_ledge();
  const WallField field(walls, domain_of({h * Vec3(-10, -10, 0), h * Vec3(30, 30, 12)}), Vec3::Zero(), h);
  const Vec3i base(20, 10, 4);
  const Probes probes = places_in(base, 1000);
  const int stencil = field.stencil(base);
  WallPlane found[4];
  int count = 0;
  for (auto _ : state) {
    count = 0;
    for (const Vec3& x : probes.x) count += field.planes_of_point(stencil, x, found, 4);
    benchmark::DoNotOptimize(count);
  }
  if (count != 1000) state.SkipWithError("not one plane a point");
  state.counters["points_per_s"] =
      benchmark::Counter(1000.0 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(planes)->Name("wall_field/planes");

void path(benchmark::State& state) {
  const Walls walls = floor_and_ledge();
  const WallField field(walls, domain_of({h * Vec3(-10, -10, 0), h * Vec3(30, 30, 12)}), Vec3::Zero(), h);
  const Vec3i base(20, 10, 4);
  const Probes probes = places_in(base, 1000);
  const int stencil = field.stencil(base);
  const Vec3 step = h * Vec3(0.03, 0.05, -0.1);
  int hits = 0, expected = 0;
  for (const Vec3& x : probes.x) expected += x[2] >= 5.31 * h && x[2] + step[2] < 5.31 * h;
  for (auto _ : state) {
    hits = 0;
    for (const Vec3& x : probes.x) hits += field.first_hit(stencil, x, x + step) ? 1 : 0;
    benchmark::DoNotOptimize(hits);
  }
  if (hits != expected || hits == 0) state.SkipWithError("wrong number of hits");
  state.counters["points_per_s"] =
      benchmark::Counter(1000.0 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(path)->Name("wall_field/path");

void set_up(benchmark::State& state) {
  std::vector<Wall> walls;
  walls.emplace_back().mesh = make_box("box", {Vec3(0, 0, 0), Vec3(2.4, 2.2, 3.5)});
  for (int i = 0; i < 4; ++i)
    walls.push_back(
        rectangle({0, i % 2 ? 1.2 : 0, 0.6 + 0.7 * i}, {2.4, 0, 0}, {0, 1.0, i % 2 ? 0.4 : -0.4}));
  const Walls all(std::move(walls));
  double area = 0;
  for (std::size_t t = 0; t < all.mesh().triangles.size(); ++t) area += all.mesh().area(static_cast<int>(t));
  double bytes = 0;
  for (auto _ : state) {
    const WallField field(all, domain_of({Vec3::Constant(-0.2), Vec3(2.6, 2.4, 3.7)}), Vec3::Zero(), h);
    bytes = static_cast<double>(field.memory_bytes());
    if (field.patch_count() != 10) state.SkipWithError("six faces and four ledges expected");
  }
  state.counters["wall_m2"] = area;
  state.counters["MB"] = bytes / 1e6;
}
BENCHMARK(set_up)->Name("wall_field/set_up")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace sluice
