#pragma once
/// The box in which everything happens.

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/vec.h"

namespace sluice {

enum class Face {
  open,      ///< what leaves is removed and counted as `outside`
  wall,      ///< a flat wall; becomes two triangles among the walls
  periodic,  ///< joins the opposite face, which is periodic too
};

struct Domain {
  Box box;
  std::array<Face, 3> low{Face::open, Face::open, Face::open};  ///< faces at box.lo, per axis
  std::array<Face, 3> high{Face::open, Face::open, Face::open};

  bool periodic(int axis) const { return low[axis] == Face::periodic; }
  bool any_periodic() const { return periodic(0) || periodic(1) || periodic(2); }
  /// Beyond a face that is not periodic.
  bool outside(const Vec3& x) const {
    for (int k = 0; k < 3; ++k)
      if (!periodic(k) && (x[k] < box.lo[k] || x[k] > box.hi[k])) return true;
    return false;
  }
  /// Position brought back through the periodic faces into [lo, hi).
  Vec3 wrapped(Vec3 x) const {
    for (int k = 0; k < 3; ++k) {
      // Nearly always inside: the division is left out.
      if (!periodic(k) || (x[k] >= box.lo[k] && x[k] < box.hi[k])) continue;
      const double length = box.hi[k] - box.lo[k];
      x[k] -= length * std::floor((x[k] - box.lo[k]) / length);
      if (x[k] >= box.hi[k]) x[k] = box.lo[k];
    }
    return x;
  }
  /// Shortest separation d (= b - a) over the periodic images.
  Vec3 nearest_image(Vec3 d) const {
    for (int k = 0; k < 3; ++k) {
      if (!periodic(k)) continue;
      const double length = box.hi[k] - box.lo[k];
      if (std::abs(d[k]) > 0.5 * length) d[k] -= length * std::nearbyint(d[k] / length);
    }
    return d;
  }
};

}  // namespace sluice
