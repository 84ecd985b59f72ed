#pragma once
/// How large a rock's shadow is: its area seen along a direction, tabulated over an octant, which is enough
/// for a superquadric. Orientation enters a drag law through it.

#include <array>

#include "dem/rock_shape.h"

namespace sluice {

class CrossSection {
 public:
  explicit CrossSection(const RockShape& shape);
  /// Area [m2] of a rock of size 1 seen along a unit vector in the body frame.
  double seen_along(const Vec3& direction) const;

 private:
  static constexpr int rows = 17;  ///< in the height of the direction and in its angle about z
  std::array<double, rows * rows> area_{};
};

}  // namespace sluice
