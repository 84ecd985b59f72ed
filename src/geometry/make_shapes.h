#pragma once
/// Plates, ledges and pipes for the parametric generators in `geometry/`.

#include <string>
#include <vector>

#include "geometry/tri_mesh.h"

namespace sluice {

using Profile = std::vector<Eigen::Vector2d>;  ///< points (x, z) of a side view [m]

/// From one side plate to the other.
struct Width {
  double from, to;  ///< y [m]
};

/// Zero-thickness sheet: the profile drawn across the width.
TriMesh make_sheet(const std::string& part, const Profile& profile, Width width);

/// Closed solid: a convex outline, counter-clockwise with x to the right and z up, drawn across the width.
TriMesh make_prism(const std::string& part, const Profile& outline, Width width);

/// Flat sheet from the corners of a convex polygon, in order.
TriMesh make_polygon(const std::string& part, const std::vector<Vec3>& corners);

enum class TubeEnds { open, capped };

struct Tube {
  Vec3 from, to;      ///< ends of the axis [m]
  double radius = 0;  ///< of the corners [m]
  int sides = 12;
  TubeEnds ends = TubeEnds::open;
};
/// Straight tube, normals outwards.
TriMesh make_tube(const std::string& part, const Tube& tube);

}  // namespace sluice
