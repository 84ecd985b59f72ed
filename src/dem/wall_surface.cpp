#include "dem/wall_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

#include "base/random.h"

namespace sluice {

namespace {
constexpr double merge_fraction = 1e-6;   // of the walls' extent: float STL keeps 6e-8 of a coordinate
constexpr double cone_tolerance = 1e-7;   // cosine; a direction on the cone's border belongs to it
constexpr double flat_cosine = 1 - 1e-8;  // edges that bend by less than 1.4e-4 rad are none

std::uint64_t cell_key(const Vec3& x, double width, int dx, int dy, int dz) {
  const auto place = [&](double v, int d) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(v / width)) + d);
  };
  return mix64(place(x.x(), dx)) ^ mix64(place(x.y(), dy) + 0x51ULL) * 3 ^
         mix64(place(x.z(), dz) + 0xa7ULL) * 7;
}

/// For each vertex the lowest one within `tolerance`.
std::vector<int> merge_vertices(const std::vector<Vec3>& x, double tolerance) {
  std::unordered_multimap<std::uint64_t, int> cells;
  std::vector<int> same(x.size());
  for (std::size_t v = 0; v < x.size(); ++v) {
    same[v] = static_cast<int>(v);
    for (int cell = 0; cell < 27; ++cell) {
      const auto [first, last] =
          cells.equal_range(cell_key(x[v], tolerance, cell % 3 - 1, cell / 3 % 3 - 1, cell / 9 - 1));
      for (auto it = first; it != last; ++it)
        if ((x[static_cast<std::size_t>(it->second)] - x[v]).norm() <= tolerance)
          same[v] = std::min(same[v], it->second);
    }
    if (same[v] == static_cast<int>(v))
      cells.emplace(cell_key(x[v], tolerance, 0, 0, 0), static_cast<int>(v));
  }
  return same;
}

using Edges = std::map<std::array<int, 2>, std::vector<std::array<int, 2>>>;  // -> (triangle, side)

Edges edges_of(const std::vector<std::array<int, 3>>& corners, const std::vector<WallTriangle>& triangles) {
  Edges edges;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    if (triangles[t].patch == -1) continue;
    for (int k = 0; k < 3; ++k) {
      const int a = corners[t][static_cast<std::size_t>(k)],
                b = corners[t][static_cast<std::size_t>((k + 1) % 3)];
      edges[{std::min(a, b), std::max(a, b)}].push_back({static_cast<int>(t), k});
    }
  }
  return edges;
}

/// Unit direction in the triangle's plane, away from side k into the triangle.
Vec3 inward(const WallTriangle& t, std::size_t k) {
  const Vec3 along = (t.corner[(k + 1) % 3] - t.corner[k]).normalized();
  const Vec3 to_third = t.corner[(k + 2) % 3] - t.corner[k];
  return (to_third - to_third.dot(along) * along).normalized();
}

bool goes_on_flat(const std::vector<Vec3>& onward) {
  for (std::size_t a = 0; a < onward.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (onward[a].dot(onward[b]) < -flat_cosine) return true;
  return false;
}
}  // namespace

bool WallFeature::admits(const Vec3& u) const {
  for (const Vec3& d : onward)
    if (u.dot(d) > cone_tolerance) return false;
  return true;
}

WallSurface::WallSurface(const Walls& walls) {
  const TriMesh& mesh = walls.mesh();
  if (mesh.triangles.empty()) return;
  const double tolerance = merge_fraction * mesh.bounds().size().norm();
  const std::vector<int> same = merge_vertices(mesh.vertices, tolerance);
  std::vector<std::array<int, 3>> corners(mesh.triangles.size());
  triangles_.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    WallTriangle& triangle = triangles_[t];
    for (std::size_t k = 0; k < 3; ++k) {
      corners[t][k] = same[static_cast<std::size_t>(mesh.triangles[t][k])];
      triangle.corner[k] = mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])];
    }
    triangle.wall = walls.wall_of(static_cast<int>(t));
    triangle.normal = mesh.normal(static_cast<int>(t));
    const bool solid = walls.all()[static_cast<std::size_t>(triangle.wall)].blocks != BlocksPhase::water_only;
    const bool has_area = triangle.normal.squaredNorm() > 0.5 && corners[t][0] != corners[t][1] &&
                          corners[t][1] != corners[t][2] && corners[t][2] != corners[t][0];
    triangle.patch = solid && has_area ? -2 : -1;  // -2: waits for its patch
    for (std::size_t k = 0; k < 3; ++k)
      triangle.inward[k] = has_area ? inward(triangle, k) : Vec3(Vec3::Zero());
  }
  merge_patches(corners, tolerance);
  find_features(corners);
}

void WallSurface::merge_patches(const std::vector<std::array<int, 3>>& corners, double tolerance) {
  const Edges edges = edges_of(corners, triangles_);
  std::vector<int> order(triangles_.size());
  std::iota(order.begin(), order.end(), 0);
  const auto area = [&](int t) {
    const auto& c = triangles_[static_cast<std::size_t>(t)].corner;
    return (c[1] - c[0]).cross(c[2] - c[0]).norm();
  };
  // From the largest triangle outwards: its plane is the best known.
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return area(a) > area(b); });
  for (int seed_index : order) {
    WallTriangle& seed = triangles_[static_cast<std::size_t>(seed_index)];
    if (seed.patch != -2) continue;
    const int patch = static_cast<int>(patches_++);
    seed.patch = patch;
    seed.offset = seed.normal.dot(seed.corner[0]);
    std::vector<int> waiting{seed_index};
    while (!waiting.empty()) {
      const std::size_t t = static_cast<std::size_t>(waiting.back());
      waiting.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const int a = corners[t][k], b = corners[t][(k + 1) % 3];
        for (const auto& [next, side] : edges.at({std::min(a, b), std::max(a, b)})) {
          WallTriangle& other = triangles_[static_cast<std::size_t>(next)];
          if (other.patch != -2 || other.wall != seed.wall) continue;
          const bool in_plane = std::all_of(other.corner.begin(), other.corner.end(), [&](const Vec3& c) {
            return std::abs(seed.normal.dot(c) - seed.offset) <= tolerance;
          });
          if (!in_plane) continue;
          other.patch = patch;
          other.normal = seed.normal;
          other.offset = seed.offset;
          waiting.push_back(next);
        }
      }
    }
  }
}

void WallSurface::find_features(const std::vector<std::array<int, 3>>& corners) {
  std::map<int, int> vertex_at;
  for (const auto& [ends, sides] : edges_of(corners, triangles_)) {
    WallFeature edge;
    for (const auto& [t, k] : sides)
      edge.onward.push_back(triangles_[static_cast<std::size_t>(t)].inward[static_cast<std::size_t>(k)]);
    if (goes_on_flat(edge.onward)) continue;
    const WallTriangle& first = triangles_[static_cast<std::size_t>(sides.front()[0])];
    const auto side = static_cast<std::size_t>(sides.front()[1]);
    edge.end = {first.corner[side], first.corner[(side + 1) % 3]};
    edge.patch = first.patch;
    edge.wall = first.wall;
    for (const auto& [t, k] : sides)
      triangles_[static_cast<std::size_t>(t)].edge[static_cast<std::size_t>(k)] =
          static_cast<int>(edges_.size());
    edges_.push_back(std::move(edge));
    for (int v : ends) vertex_at.emplace(v, -1);
  }
  // A vertex bounds the surface along all edges of its triangles, bent or flat.
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    WallTriangle& triangle = triangles_[t];
    if (triangle.patch < 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto found = vertex_at.find(corners[t][k]);
      if (found == vertex_at.end()) continue;
      if (found->second < 0) {
        found->second = static_cast<int>(vertices_.size());
        vertices_.push_back({{triangle.corner[k], triangle.corner[k]}, triangle.patch, triangle.wall, {}});
      }
      triangle.vertex[k] = found->second;
      WallFeature& vertex = vertices_[static_cast<std::size_t>(found->second)];
      vertex.onward.push_back((triangle.corner[(k + 1) % 3] - triangle.corner[k]).normalized());
      vertex.onward.push_back((triangle.corner[(k + 2) % 3] - triangle.corner[k]).normalized());
    }
  }
}

std::size_t WallSurface::memory_bytes() const {
  std::size_t bytes = triangles_.capacity() * sizeof(WallTriangle);
  for (const auto* features : {&edges_, &vertices_}) {
    bytes += features->capacity() * sizeof(WallFeature);
    for (const WallFeature& f : *features) bytes += f.onward.capacity() * sizeof(Vec3);
  }
  return bytes;
}

bool inside_triangle(const WallTriangle& triangle, const Vec3& x, double tolerance) {
  for (std::size_t k = 0; k < 3; ++k)
    if (triangle.inward[k].dot(x - triangle.corner[k]) < -tolerance) return false;
  return true;
}

}  // namespace sluice
