#pragma once
/// The slow and certain way to ask whether a segment crosses a wall.

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/tri_mesh.h"
#include "mpm/wall_scenes.h"

namespace sluice::wall_scenes {

/// What the brute-force search over all triangles says about a segment.
enum class Crossed { no, yes, unclear };

/// First principles: signed volumes in double; a segment that grazes an edge or a plane is unclear.
inline Crossed crosses(const TriMesh& mesh, const Vec3& a, const Vec3& b) {
  Crossed result = Crossed::no;
  for (const auto& t : mesh.triangles) {
    const Vec3 &p = mesh.vertices[static_cast<std::size_t>(t[0])],
               &q = mesh.vertices[static_cast<std::size_t>(t[1])],
               &r = mesh.vertices[static_cast<std::size_t>(t[2])];
    const Vec3 n = (q - p).cross(r - p);
    const double area = n.norm();
    if (area == 0) continue;
    const double height_a = n.dot(a - p) / area, height_b = n.dot(b - p) / area;
    const double tie = 1e-9 * spacing;
    if ((height_a > tie && height_b > tie) || (height_a < -tie && height_b < -tie)) continue;
    const Vec3 x = a + height_a / (height_a - height_b) * (b - a);
    double inside = 1e300;
    for (const auto& [c, d] : {std::pair{p, q}, std::pair{q, r}, std::pair{r, p}})
      inside = std::min(inside, n.cross(d - c).normalized().dot(x - c));
    if (std::abs(height_a) <= tie || std::abs(height_b) <= tie) {
      if (inside > -1e-3 * spacing) return Crossed::unclear;
    } else if (inside > 1e-4 * spacing) {
      result = Crossed::yes;
    } else if (inside > -1e-4 * spacing && result == Crossed::no) {
      result = Crossed::unclear;  // at an edge: another triangle may settle it
    }
  }
  return result;
}

}  // namespace sluice::wall_scenes
