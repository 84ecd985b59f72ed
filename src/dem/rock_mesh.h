#pragma once
/// Closed triangulation of a rock's shape.

#include "dem/rock_shape.h"
#include "geometry/tri_mesh.h"

namespace sluice {

/// About the centre, of size 1, normals outwards, with the volume of the shape to rounding: corners lie a
/// little outside its surface, middles of facets inside. A cube whose faces have `divisions` squares along
/// each side, stretched to the semi-axes and pushed out to the surface.
/// @param divisions  at least 1
TriMesh make_rock_mesh(const RockShape& shape, int divisions);

/// How far outside the shape the corners of that mesh lie, over their distance from the centre.
double rock_mesh_excess(const RockShape& shape, const TriMesh& mesh);

}  // namespace sluice
