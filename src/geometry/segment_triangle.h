#pragma once
/// Segment against one triangle, decided by exact signs.

#include <optional>

#include "base/vec.h"

namespace sluice {

/// Where the closed segment from `from` to `to` first meets the closed triangle, 0 to 1; nothing if it
/// does not, or if the triangle has no area. Whether they meet is exact; where is rounded.
std::optional<double> segment_meets_triangle(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b,
                                             const Vec3& c);

/// True if the segment passes from one side to the other; edges and vertices are passed on one
/// side, so that a closed surface is crossed once there, too. Segments in the triangle's plane do not cross.
bool segment_crosses_once(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace sluice
