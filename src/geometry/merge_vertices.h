#pragma once
/// Joining vertices of exactly the same position, as STL's triangles need.

#include <cstddef>

#include "geometry/tri_mesh.h"

namespace sluice {

/// Joins vertices whose coordinates are equal (0 and -0 are) and drops those no triangle uses; the order of
/// first use is kept. Returns how many vertices went.
std::size_t merge_equal_vertices(TriMesh& mesh);

}  // namespace sluice
