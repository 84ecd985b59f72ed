#pragma once
/// Triangles in named parts.

#include <array>
#include <string>
#include <vector>

#include "base/vec.h"

namespace sluice {

struct TriMesh {
  std::vector<Vec3> vertices;                 ///< #V x 3 [m]
  std::vector<std::array<int, 3>> triangles;  ///< #T x 3, indices of vertices
  std::vector<int> part;                      ///< #T, index of part_names
  std::vector<std::string> part_names;

  Box bounds() const;
  Vec3 normal(int triangle) const;  ///< unit; zero for a degenerate triangle
  double area(int triangle) const;  ///< [m2]
  void append(const TriMesh& other);
};

/// Two triangles a face; corners of a rectangle in order around it.
TriMesh make_rectangle(const std::string& part, const std::array<Vec3, 4>& corners);
/// Closed box of twelve triangles, normals outwards.
TriMesh make_box(const std::string& part, const Box& box);

}  // namespace sluice
