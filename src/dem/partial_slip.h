#pragma once
/// Shear of two elastic spheres in contact that slip from the rim inwards, as Cattaneo (1938) and Mindlin
/// (1949) found for a constant push and Jaeger (1998) and Ciavarella (1998, J. Appl. Mech. 65:998) for any
/// path: the method of dimensionality reduction (Popov & Hess 2014, Phys. Mesomech. 17:232) is exact there.
///
/// The half width of the contact is cut into `shear_rings` rings of equal width, each with a spring across
/// of an equal share of Mindlin's stiffness. The push on ring i is that of a parabola cut off at the
/// surface, d (1 - x^2 / a^2), so its share of friction falls towards the rim, where a ring gives way long
/// before the whole contact slides:
///
///     force of ring i <= friction * force * 3 / (2 n) * (1 - (i^2 + i + 1/3) / n^2),   i = 0 ... n - 1
///
/// As the contact grows or shrinks the rings do too: what they were stretched is read off where they now
/// lie; ground gained at the rim is unstretched, ground lost at the rim takes its energy along.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/vec.h"

namespace sluice {

constexpr std::size_t shear_rings =
    8;  // to and fro loses 6 % too much at 0.6 of the way to sliding; 6 rings 8 %

struct RingShear {
  Vec3 force = Vec3::Zero();  ///< that the springs oppose the stretch with, and at most the limit [N]
  double held = 0;            ///< [J]
};

inline std::array<Vec3, shear_rings> no_stretch() {
  std::array<Vec3, shear_rings> rings;
  rings.fill(Vec3::Zero());
  return rings;
}

/// Sum of squares [m2].
inline double squares_of(std::span<const Vec3> rings) {
  double sum = 0;
  for (const Vec3& stretch : rings) sum += stretch.squaredNorm();
  return sum;
}

/// Moves the rings to a contact whose half width is `growth` times what it was. What that takes from the
/// springs is lost: with Mindlin's stiffness, which grows as the width, they hold no more than before.
/// @pre growth > 0
inline void resize_rings(std::span<Vec3> rings, double growth) {
  std::array<Vec3, shear_rings> before;
  std::copy(rings.begin(), rings.end(), before.begin());
  const double held = squares_of(before);
  if (held == 0) return;
  for (std::size_t i = 0; i < shear_rings; ++i) {
    const double place = (static_cast<double>(i) + 0.5) * growth - 0.5;  // in rings of the old width
    if (place <= 0) {
      rings[i] = before[0];
      continue;
    }
    const auto inner = static_cast<std::size_t>(std::min(place, double{shear_rings}));
    const double share = place - static_cast<double>(inner);
    if (inner + 1 < shear_rings)
      rings[i] = before[inner] + share * (before[inner + 1] - before[inner]);
    else  // the old rim, half a ring beyond the middle of the last
      rings[i] = inner < shear_rings ? Vec3(std::max(0.0, 1 - 2 * share) * before[inner]) : Vec3::Zero();
  }
  const double now = growth * squares_of(rings);
  if (now > held)
    for (Vec3& stretch : rings) stretch *= std::sqrt(held / now);
}

/// Stretches the rings by `slip` [m] across the unit vector n, each until it gives way.
/// @param stiffness  of all together [N/m]
/// @param limit      friction times force [N]
inline RingShear shear(std::span<Vec3> rings, const Vec3& n, const Vec3& slip, double stiffness,
                       double limit) {
  constexpr double count = double{shear_rings};
  const double one = stiffness / count;
  RingShear result;
  for (std::size_t i = 0; i < shear_rings; ++i) {
    Vec3& stretch = rings[i];
    const double length = stretch.norm();
    stretch -= stretch.dot(n) * n;  // turned into the plane, its length kept
    const double left = stretch.norm();
    if (left > 0) stretch *= length / left;
    stretch += slip;
    const auto at = static_cast<double>(i);
    const double most = limit * 1.5 / count * (1 - (at * at + at + 1.0 / 3) / (count * count));
    const double pull = one * stretch.norm();
    if (pull > most) stretch *= most / pull;
    result.force -= one * stretch;
    result.held += 0.5 * one * stretch.squaredNorm();
  }
  return result;
}

}  // namespace sluice
