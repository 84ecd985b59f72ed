#pragma once
/// Polygons of CAD files cut into triangles. (assimp 5.2 covers the notch of an L-shaped facet.)

#include <array>
#include <optional>
#include <vector>

#include "base/vec.h"

namespace sluice {

/// Cuts ears off a simple polygon, seen along its normal (Meisters 1975), with exact signs; every corner is
/// used and every triangle has an area and the polygon's orientation.
/// @param corners  indices of vertices, at least three
/// @return as many triangles as corners less two, or nothing if the polygon is not simple or has no area;
///         a triangle is returned as it is, whatever its area
std::optional<std::vector<std::array<int, 3>>> triangulate_polygon(const std::vector<Vec3>& vertices,
                                                                   const std::vector<int>& corners);

}  // namespace sluice
