#pragma once
/// What is wrong, or merely unusual, with a part; and its repair on request (CGAL).

#include <cstddef>
#include <string>
#include <vector>

#include "geometry/tri_mesh.h"

namespace sluice {

struct PartAudit {
  std::string part;
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  bool closed = false;      ///< no boundary edges
  bool consistent = false;  ///< orientable with the orientation it has
  std::size_t boundary_loops = 0;
  std::size_t boundary_edges = 0;
  std::size_t non_manifold_edges = 0;
  std::size_t degenerate = 0;          ///< facets without area
  std::size_t duplicates = 0;          ///< facets that repeat another
  std::size_t self_intersections = 0;  ///< pairs of facets
  std::size_t components = 0;
  Box bounds;         ///< [m]
  double area = 0;    ///< [m2]
  double volume = 0;  ///< of a closed consistent part, else 0 [m3]
};

/// One entry a part, in part order.
std::vector<PartAudit> audit_mesh(const TriMesh& mesh);

struct RepairReport {
  std::size_t merged_vertices = 0, removed_degenerate = 0, removed_duplicates = 0, flipped = 0;
};
/// Merges equal vertices, removes degenerate and duplicate facets, orients facets alike. Only on request.
RepairReport repair_mesh(TriMesh& mesh);

}  // namespace sluice
