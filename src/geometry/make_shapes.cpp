#include "geometry/make_shapes.h"

#include <cmath>
#include <numbers>

namespace sluice {

namespace {

int index(std::size_t i) {
  return static_cast<int>(i);
}

TriMesh named(const std::string& part) {
  TriMesh mesh;
  mesh.part_names = {part};
  return mesh;
}

void finish(TriMesh& mesh) {
  mesh.part.assign(mesh.triangles.size(), 0);
}

}  // namespace

TriMesh make_sheet(const std::string& part, const Profile& profile, Width width) {
  TriMesh mesh = named(part);
  for (const auto& p : profile) {
    mesh.vertices.emplace_back(p.x(), width.from, p.y());
    mesh.vertices.emplace_back(p.x(), width.to, p.y());
  }
  for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
    const int a = index(2 * k);
    mesh.triangles.push_back({a, a + 2, a + 3});
    mesh.triangles.push_back({a, a + 3, a + 1});
  }
  finish(mesh);
  return mesh;
}

TriMesh make_prism(const std::string& part, const Profile& outline, Width width) {
  TriMesh mesh = named(part);
  const int n = index(outline.size());
  for (double y : {width.from, width.to})
    for (const auto& p : outline) mesh.vertices.emplace_back(p.x(), y, p.y());
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    mesh.triangles.push_back({k, k + n, next + n});
    mesh.triangles.push_back({k, next + n, next});
  }
  for (int k = 1; k + 1 < n; ++k) {
    mesh.triangles.push_back({0, k, k + 1});
    mesh.triangles.push_back({n, n + k + 1, n + k});
  }
  finish(mesh);
  return mesh;
}

TriMesh make_polygon(const std::string& part, const std::vector<Vec3>& corners) {
  TriMesh mesh = named(part);
  mesh.vertices = corners;
  for (int k = 1; k + 1 < index(corners.size()); ++k) mesh.triangles.push_back({0, k, k + 1});
  finish(mesh);
  return mesh;
}

TriMesh make_tube(const std::string& part, const Tube& tube) {
  TriMesh mesh = named(part);
  const auto [e1, e2] = tangent_frame((tube.to - tube.from).normalized());
  const int n = tube.sides;
  for (const Vec3& end : {tube.from, tube.to})
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n;
      mesh.vertices.push_back(end + tube.radius * (std::cos(angle) * e1 + std::sin(angle) * e2));
    }
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    mesh.triangles.push_back({k, next, next + n});
    mesh.triangles.push_back({k, next + n, k + n});
  }
  if (tube.ends == TubeEnds::capped)
    for (int k = 1; k + 1 < n; ++k) {
      mesh.triangles.push_back({0, k + 1, k});
      mesh.triangles.push_back({n, n + k, n + k + 1});
    }
  finish(mesh);
  return mesh;
}

}  // namespace sluice
