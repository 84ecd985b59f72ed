#pragma once
/// Small scenes for the tests of the rocks.

#include <array>
#include <memory>
#include <vector>

#include "dem/dem_system.h"
#include "dem/rock_shape.h"

namespace sluice::test {

constexpr double rock_density = 2700;  // [kg/m3]

/// One material for rocks (0) and one for walls (1), every pair alike.
inline Materials alike(const PairProperties& pair, double density = rock_density) {
  Materials materials;
  materials.all = {{"rock", density}, {"steel", 0}};
  materials.pairs.assign(4, pair);
  return materials;
}

inline DemScene scene_of(const PairProperties& pair, double size,
                         std::vector<RockShape> shapes = {make_sphere()}) {
  DemScene scene;
  scene.materials = alike(pair);
  scene.shapes = std::move(shapes);
  scene.domain.box = {Vec3::Constant(-10), Vec3::Constant(10)};
  scene.smallest_size = scene.largest_size = size;
  scene.densest = rock_density;
  return scene;
}

/// Level plane through z = 0 of n x n squares, corners moved off the lattice so that no two triangles
/// are alike; n = 1 is a plain rectangle.
inline Wall plane_wall(double half_width, int n = 1, const Quat& turned = Quat::Identity()) {
  Wall wall;
  wall.name = "plane";
  wall.material = 1;
  wall.mesh.part_names = {"plane"};
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const bool border = i == 0 || j == 0 || i == n || j == n;
      const double off = border ? 0 : 0.3 * std::sin(12.9 * i + 78.2 * j);
      const double x = -half_width + 2 * half_width * (i + off) / n;
      const double y = -half_width + 2 * half_width * (j + 0.7 * off) / n;
      wall.mesh.vertices.push_back(turned * Vec3(x, y, 0));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      // Orientation alternates: normals say nothing.
      wall.mesh.triangles.push_back({a, b, c});
      wall.mesh.triangles.push_back({a, d, c});
      wall.mesh.part.insert(wall.mesh.part.end(), {0, 0});
    }
  return wall;
}

inline Walls walls_of(Wall wall) {
  std::vector<Wall> all;
  all.push_back(std::move(wall));
  return Walls(std::move(all));
}

inline void run(DemSystem& dem, double seconds, double dt = 0) {
  if (dt == 0) dt = dem.step_size();
  const int steps = static_cast<int>(std::ceil(seconds / dt - 1e-9));
  for (int k = 0; k < steps; ++k) dem.step(k * dt, dt);
}

}  // namespace sluice::test
