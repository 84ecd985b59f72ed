#include "geometry/tri_mesh.h"

#include <algorithm>

namespace sluice {

namespace {
/// Twice the area of a triangle times its unit normal [m2].
Vec3 area_vector(const TriMesh& mesh, int triangle) {
  const auto& t = mesh.triangles[static_cast<std::size_t>(triangle)];
  const Vec3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
  const Vec3& b = mesh.vertices[static_cast<std::size_t>(t[1])];
  const Vec3& c = mesh.vertices[static_cast<std::size_t>(t[2])];
  return (b - a).cross(c - a);
}
}  // namespace

Box TriMesh::bounds() const {
  Box box;
  for (const auto& t : triangles)
    for (int v : t) box.include(vertices[static_cast<std::size_t>(v)]);
  return box;
}

Vec3 TriMesh::normal(int triangle) const {
  const Vec3 n = area_vector(*this, triangle);
  const double length = n.stableNorm();
  return length > 0 ? Vec3(n / length) : Vec3(Vec3::Zero());
}

double TriMesh::area(int triangle) const {
  return 0.5 * area_vector(*this, triangle).stableNorm();
}

void TriMesh::append(const TriMesh& other) {
  const int first_vertex = static_cast<int>(vertices.size());
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  // A part of the same name is the same part.
  std::vector<int> part_here;
  for (const std::string& name : other.part_names) {
    const auto found = std::find(part_names.begin(), part_names.end(), name);
    part_here.push_back(static_cast<int>(found - part_names.begin()));
    if (found == part_names.end()) part_names.push_back(name);
  }
  for (std::size_t t = 0; t < other.triangles.size(); ++t) {
    std::array<int, 3> corners = other.triangles[t];
    for (int& v : corners) v += first_vertex;
    triangles.push_back(corners);
    part.push_back(part_here[static_cast<std::size_t>(other.part[t])]);
  }
}

TriMesh make_rectangle(const std::string& part, const std::array<Vec3, 4>& corners) {
  TriMesh mesh;
  mesh.vertices.assign(corners.begin(), corners.end());
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.part = {0, 0};
  mesh.part_names = {part};
  return mesh;
}

TriMesh make_box(const std::string& part, const Box& box) {
  TriMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.emplace_back(k & 1 ? box.hi.x() : box.lo.x(), k & 2 ? box.hi.y() : box.lo.y(),
                               k & 4 ? box.hi.z() : box.lo.z());
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  mesh.part.assign(12, 0);
  mesh.part_names = {part};
  return mesh;
}

}  // namespace sluice
