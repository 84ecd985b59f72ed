#pragma once
/// What the walls mean for a node or a point: its active planes, and how much of its support is open.

#include "mpm/wall_field.h"
#include "mpm/wall_sight.h"

namespace sluice {

/// Reach of a quadratic B-spline, and of planes [h].
constexpr double plane_reach = 1.5;

/// Active planes of a place, nearest first; see WallField::planes_of_point. Distances in grid units.
/// @param x  the place;  @param seen_at  where it counts as being (nodes are seen off their place)
int active_planes(const Sight& sight, const StencilRecord& record, const Vec3& x, const Vec3& seen_at,
                  WallPlane* out, int max);

/// Fraction of the quadratic B-spline about node base + 1 that lies in sight of it.
double open_fraction_of(const Sight& sight, const StencilRecord& record);

}  // namespace sluice
