#pragma once
/// Triangles of a superquadric for the eye: frames and pictures.
///
/// The grid of a cube is drawn on the surface along rays from the centre, so that a ball and a box both
/// get even triangles.

#include <array>
#include <vector>

#include "base/vec.h"

namespace sluice {

struct SurfaceMesh {
  std::vector<Vec3> vertices;                 ///< #V x 3 [m]
  std::vector<Vec3> normals;                  ///< #V x 3, unit, outwards
  std::vector<std::array<int, 3>> triangles;  ///< #T x 3, outwards
};

/// The cube's grid with `divisions` squares along an edge; vertices shared, on the unit cube.
SurfaceMesh cube_grid(int divisions);

/// |x/a|^m + |y/b|^m + |z/c|^m = 1 in its body frame, drawn on the grid of a cube.
/// @param semi_axes  [m]
SurfaceMesh superquadric_mesh(const SurfaceMesh& grid, const Vec3& semi_axes, double m);

}  // namespace sluice
