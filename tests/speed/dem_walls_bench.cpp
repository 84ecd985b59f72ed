/// Speed of spheres at walls: a hopper that discharges, and the search for contacts alone.

#include <fmt/format.h>

#include <cmath>

#include "base/random.h"
#include "dem/wall_contact.h"
#include "speed/dem_reference.h"
#include "speed/dem_scenes.h"
#include "speed/speed.h"

namespace sluice::speed {
namespace {

constexpr double size = 0.02;

/// A flat quadrilateral of n x n squares, two triangles each.
void add_sheet(TriMesh& mesh, const std::array<Vec3, 4>& corners, int n) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
      mesh.vertices.push_back((1 - v) * ((1 - u) * corners[0] + u * corners[1]) +
                              v * ((1 - u) * corners[3] + u * corners[2]));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = first + j * (n + 1) + i;
      mesh.triangles.push_back({a, a + 1, a + n + 2});
      mesh.triangles.push_back({a, a + n + 2, a + n + 1});
      mesh.part.insert(mesh.part.end(), {0, 0});
    }
}

/// Each mesh a wall of its own: no history goes over from one to another.
Walls walls_of(std::vector<TriMesh> meshes) {
  std::vector<Wall> all;
  for (TriMesh& mesh : meshes) {
    mesh.part_names = {"sheet"};
    Wall& wall = all.emplace_back();
    wall.name = fmt::format("sheet {}", all.size());
    wall.material = 1;
    wall.mesh = std::move(mesh);
  }
  return Walls(std::move(all));
}

/// Hopper: a square shaft above four walls that lean in to a square outlet; 8 sheets, 5776 triangles.
struct Hopper {
  static constexpr double half_width = 0.2, half_outlet = 0.08, knee = 0.2, top = 1.4;  ///< [m]
  static constexpr int squares = 19;
  std::vector<TriMesh> sheets;
  std::vector<PlainWall> walls;

  Hopper() {
    for (int side = 0; side < 4; ++side) {
      const Mat3 turn = Eigen::AngleAxisd(side * 0.5 * std::numbers::pi, Vec3::UnitZ()).toRotationMatrix();
      const double w = half_width, o = half_outlet;
      add({turn * Vec3(w, -w, knee), turn * Vec3(w, -w, top), turn * Vec3(w, w, top),
           turn * Vec3(w, w, knee)});
      add({turn * Vec3(o, -o, 0), turn * Vec3(w, -w, knee), turn * Vec3(w, w, knee), turn * Vec3(o, o, 0)});
    }
  }
  /// Near the outlet a rock meets the rim, which the reference has not; its error fades over a few layers.
  static bool near_outlet(const Vec3& x) { return x.z() < 5 * size; }

 private:
  void add(const std::array<Vec3, 4>& corners) {
    add_sheet(sheets.emplace_back(), corners, squares);
    // Counter-clockwise about the normal, which points inwards.
    const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    walls.push_back({{corners.begin(), corners.end()}, normal});
  }
};

class HopperBench {
 public:
  void operator()(benchmark::State& state) {
    if (!dem_) set_up();
    const std::size_t before = dem_->rocks().count();
    const double seconds = time_steps(state, [&] { step(); });
    if (!wrong_.empty()) return state.SkipWithError(wrong_.c_str());
    if (t_ > longest) return state.SkipWithError("the hopper ran empty: measure for a shorter time");
    const double rocks = 0.5 * static_cast<double>(before + dem_->rocks().count());
    state.counters["rock_steps_per_s"] = rate(state, rocks, seconds);
    state.counters["coordination"] = 2 * static_cast<double>(dem_->contact_count()) / rocks;
    state.counters["triangles"] = static_cast<double>(walls_.mesh().triangles.size());
    state.counters["worst_departure"] = worst_;
  }

 private:
  static constexpr double settled = 0.2, longest = 4;  // [s]
  static constexpr int followed_steps = 20;

  void step() {
    dem_->step(t_, dem_->step_size());
    t_ += dem_->step_size();
    // What has fallen out is gone.
    if (++steps_ % 100 == 0) dem_->remove_outside();
  }

  void make_system() {
    DemScene scene;
    scene.materials.all = {{"rock", density}, {"steel", 0}};
    scene.materials.pairs.assign(4, {restitution, friction, 0});
    scene.shapes = {make_sphere()};
    scene.smallest_size = scene.largest_size = size;
    scene.densest = density;
    scene.domain.box = {Vec3(-0.3, -0.3, -0.2), Vec3(0.3, 0.3, 1.6)};
    dem_ = std::make_unique<DemSystem>(config_of_beds(), scene, walls_);
  }

  void set_up() {
    // 10 000 rocks in loose layers; they settle while the first ones leave.
    make_system();
    Random random(2);
    const double spacing = 1.03 * size;
    for (int layer = 0; dem_->rocks().count() < 10000; ++layer) {
      const double z = (layer + 0.5) * spacing;
      const double half =
          Hopper::half_outlet + (Hopper::half_width - Hopper::half_outlet) * std::min(1.0, z / Hopper::knee);
      const int n = static_cast<int>((2 * half - 1.5 * size) / spacing) + 1;
      for (int k = 0; k < n * n && dem_->rocks().count() < 10000; ++k)
        dem_->add({.x = Vec3((k % n - 0.5 * (n - 1)) * spacing, (k / n - 0.5 * (n - 1)) * spacing, z) +
                        0.02 * size * random.on_sphere(),
                   .v = 0.1 * random.on_sphere(),
                   .size = size});
    }
    while (t_ < settled) step();
    // The same rocks without a memory, so that the reference can follow from the first step.
    const Rocks old = dem_->rocks();
    make_system();
    for (std::size_t i = 0; i < old.count(); ++i)
      dem_->add({.x = old.x[i], .v = old.v[i], .w = old.w[i], .q = old.q[i], .size = old.size[i]});
    follow();
  }

  void follow() {
    PlainRocks reference(*dem_, restitution, friction, hopper_.walls);
    std::size_t at_walls = 0;
    for (int k = 0; k < followed_steps && wrong_.empty(); ++k) {
      dem_->step(t_, dem_->step_size());
      t_ += dem_->step_size();
      reference.leave_out(Hopper::near_outlet);
      const Departure d = reference.follow(*dem_, dem_->step_size(), 1e-8);
      worst_ = std::max({worst_, d.velocity, d.turning});
      at_walls = d.wall_contacts;
      if (d.wrong_share > 0) wrong_ = fmt::format("departs from the reference by {:.2g}", worst_);
    }
    if (at_walls < 500) wrong_ = fmt::format("only {} contacts with walls", at_walls);
  }

  Hopper hopper_;
  Walls walls_ = walls_of(hopper_.sheets);
  std::unique_ptr<DemSystem> dem_;
  double t_ = 0, worst_ = 0;
  int steps_ = 0;
  std::string wrong_;
};

void cached_walls(benchmark::State& state) {
  constexpr std::size_t count = 50000;
  TriMesh mesh;
  add_sheet(mesh, {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)}, 100);
  const Walls walls = walls_of({mesh});
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
  const auto search = [&](std::size_t i) {
    find_sphere_contacts(surface, near[i], x[i], 0.5 * size, {}, scratch);
  };
  std::size_t touching = 0;
  const double seconds = time_steps(state, [&] {
    touching = 0;
    for (std::size_t i = 0; i < count; ++i) {
      search(i);
      touching += scratch.found.size();
    }
  });
  // Against the plane: who touches it, how deep, where.
  std::size_t expected = 0;
  double worst = 0;
  for (std::size_t i = 0; i < count; ++i) {
    search(i);
    const double overlap = 0.5 * size - x[i].z();
    expected += overlap > 0;
    for (const WallTouch& touch : scratch.found)
      worst =
          std::max({worst, std::fabs(touch.overlap - overlap), (touch.normal + Vec3::UnitZ()).norm() * size,
                    (touch.point - Vec3(x[i].x(), x[i].y(), touch.point.z())).norm()});
  }
  if (touching != expected || !(worst < 1e-14))
    return state.SkipWithError("contacts differ from those with the plane");
  state.counters["queries_per_s"] = rate(state, static_cast<double>(count), seconds);
}

const bool registered = [] {
  benchmark::RegisterBenchmark("dem_spheres/walls_10k", HopperBench())->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("rock_walls/cached_50k", cached_walls)->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace sluice::speed
