#pragma once
/// Meshes for tests.

#include <cmath>
#include <map>

#include "base/random.h"
#include "geometry/tri_mesh.h"

namespace sluice {

/// Unit sphere from an octahedron, each triangle cut into four `levels` times: 8 * 4^levels triangles.
inline TriMesh make_test_sphere(int levels) {
  TriMesh mesh;
  mesh.part_names = {"sphere"};
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middle;
    const auto between = [&](int a, int b) {
      const auto [entry, is_new] =
          middle.try_emplace(std::minmax(a, b), static_cast<int>(mesh.vertices.size()));
      if (is_new)
        mesh.vertices.push_back(
            (mesh.vertices[static_cast<std::size_t>(a)] + mesh.vertices[static_cast<std::size_t>(b)])
                .normalized());
      return entry->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
  }
  mesh.part.assign(mesh.triangles.size(), 0);
  return mesh;
}

/// Triangles at random in the unit cube, with edges of about `size`.
inline TriMesh make_test_soup(int count, double size, std::uint64_t seed) {
  Random random(seed);
  TriMesh mesh;
  mesh.part_names = {"soup"};
  const auto point = [&](double scale) {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    return Vec3(scale * Vec3(x, y, z));
  };
  for (int t = 0; t < count; ++t) {
    const Vec3 at = point(1.0);
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back(at + point(size));
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  mesh.part.assign(mesh.triangles.size(), 0);
  return mesh;
}

/// Signed volume of a closed mesh [m3].
inline double volume_of(const TriMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += mesh.vertices[static_cast<std::size_t>(a)].dot(mesh.vertices[static_cast<std::size_t>(b)].cross(
                  mesh.vertices[static_cast<std::size_t>(c)])) /
              6;
  return volume;
}

}  // namespace sluice
