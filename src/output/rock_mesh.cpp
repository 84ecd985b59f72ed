#include "output/rock_mesh.h"

#include <cmath>
#include <map>

namespace sluice {

SurfaceMesh cube_grid(int divisions) {
  SurfaceMesh mesh;
  std::map<std::array<int, 3>, int> index_of;  // grid place -> vertex; shared along the cube's edges
  const auto vertex = [&](const std::array<int, 3>& place) {
    const auto [found, is_new] = index_of.try_emplace(place, static_cast<int>(mesh.vertices.size()));
    if (is_new) {
      Vec3 x;
      for (int k = 0; k < 3; ++k) x[k] = 2.0 * place[static_cast<std::size_t>(k)] / divisions - 1.0;
      // equal angles rather than equal lengths: even triangles on a ball
      for (int k = 0; k < 3; ++k) x[k] = std::tan(x[k] * std::atan(1.0));
      mesh.vertices.push_back(x);
      mesh.normals.push_back(x.normalized());
    }
    return found->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    for (const int side : {0, divisions}) {
      for (int i = 0; i < divisions; ++i) {
        for (int j = 0; j < divisions; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> place{};
            place[a] = side;
            place[b] = i + di;
            place[c] = j + dj;
            return vertex(place);
          };
          const int p = corner(0, 0), q = corner(1, 0), r = corner(1, 1), s = corner(0, 1);
          if (side == 0) {
            mesh.triangles.push_back({p, r, q});
            mesh.triangles.push_back({p, s, r});
          } else {
            mesh.triangles.push_back({p, q, r});
            mesh.triangles.push_back({p, r, s});
          }
        }
      }
    }
  }
  return mesh;
}

SurfaceMesh superquadric_mesh(const SurfaceMesh& grid, const Vec3& semi_axes, double m) {
  SurfaceMesh mesh;
  mesh.triangles = grid.triangles;
  mesh.vertices.reserve(grid.vertices.size());
  mesh.normals.reserve(grid.vertices.size());
  for (const Vec3& g : grid.vertices) {
    const Vec3 u = g / std::pow(g.cwiseAbs().array().pow(m).sum(), 1 / m);
    const Vec3 gradient =
        (u.cwiseAbs().array().pow(m - 1) * u.array().sign()).matrix().cwiseQuotient(semi_axes);
    mesh.vertices.push_back(u.cwiseProduct(semi_axes));
    mesh.normals.push_back(gradient.normalized());
  }
  return mesh;
}

}  // namespace sluice
