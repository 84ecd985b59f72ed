#include "dem/rock_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace sluice {

namespace {

/// Six times the volume.
double sixfold_volume(const TriMesh& mesh) {
  double sum = 0;
  for (const std::array<int, 3>& t : mesh.triangles) {
    const auto corner = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    sum += corner(0).dot(corner(1).cross(corner(2)));
  }
  return sum;
}

}  // namespace

TriMesh make_rock_mesh(const RockShape& shape, int divisions) {
  TriMesh mesh;
  mesh.part_names = {"rock"};
  std::map<std::array<int, 3>, int> known;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [place, is_new] = known.try_emplace(at, static_cast<int>(mesh.vertices.size()));
    if (is_new) {
      Vec3 x;
      for (int k = 0; k < 3; ++k) {  // equal angles, seen from the centre
        const double across = 2.0 * at[static_cast<std::size_t>(k)] / divisions - 1;
        x[k] = std::tan(std::numbers::pi / 4 * across) * shape.semi_axes[k];
      }
      const double f = superquadric_function(shape.semi_axes, shape.blockiness, x);
      mesh.vertices.push_back(x * std::pow(f, -1 / shape.blockiness));
    }
    return place->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, divisions})
      for (int i = 0; i < divisions; ++i)
        for (int j = 0; j < divisions; ++j) {
          std::array<int, 4> corner;
          for (std::size_t c = 0; c < 4; ++c) {
            std::array<int, 3> at;
            at[axis] = side;
            at[(axis + 1) % 3] = i + (c == 1 || c == 2);
            at[(axis + 2) % 3] = j + (c == 2 || c == 3);
            corner[c] = vertex(at);
          }
          if (side == 0) std::swap(corner[1], corner[3]);
          mesh.triangles.push_back({corner[0], corner[1], corner[2]});
          mesh.triangles.push_back({corner[0], corner[2], corner[3]});
        }
  mesh.part.assign(mesh.triangles.size(), 0);
  const double grow = std::cbrt(6 * shape.volume / sixfold_volume(mesh));
  for (Vec3& x : mesh.vertices) x *= grow;
  return mesh;
}

double rock_mesh_excess(const RockShape& shape, const TriMesh& mesh) {
  const double f = superquadric_function(shape.semi_axes, shape.blockiness, mesh.vertices.front());
  return std::pow(f, 1 / shape.blockiness) - 1;
}

}  // namespace sluice
