#include "base/vec.h"

#include <cmath>

namespace sluice {

// Duff et al. (2017), "Building an orthonormal basis, revisited".
std::array<Vec3, 2> tangent_frame(const Vec3& n) {
  const double sign = std::copysign(1.0, n.z());
  const double a = -1.0 / (sign + n.z());
  const double b = n.x() * n.y() * a;
  return {Vec3(1.0 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()),
          Vec3(b, sign + n.y() * n.y() * a, -n.y())};
}

}  // namespace sluice
