#pragma once
/// Convex bodies with a smooth surface, as walls of the fluid: superquadrics.
///
/// f(x) = (sum |x_i / a_i|^m)^(1/m), 1 on the surface, is convex and grows in proportion along rays. Near a
/// place the body counts as the ball that touches it there with its mean curvature: exact for spheres, a
/// plane on flat faces, a small ball at the edge of a block.

#include "base/pose.h"

namespace sluice {

/// The body beside a place. Lengths in the units of the body.
struct BodyFace {
  Vec3 foot = Vec3::Zero();    ///< on the surface, close to the place
  Vec3 normal = Vec3::Zero();  ///< outwards, unit
  double height = 0;           ///< of the place over the tangent plane there; negative inside
  double curvature = 0;        ///< mean

  /// Height over the touching ball at q from the foot, to first order in it; negative inside.
  double over(const Vec3& q) const { return q.dot(normal) + 0.5 * curvature * q.squaredNorm(); }
  /// True if the ball stands between two places outside it, p and q from the foot, or q lies inside.
  bool hides(const Vec3& p, const Vec3& q) const;
};

struct RoundBody {
  Vec3 semi_axes = Vec3::Zero();
  double m = 2;
  double reach = 0;  ///< bounding radius
  Pose pose;
  int wall = -1;  ///< index of WallPoses

  bool is_ball() const { return m == 2 && semi_axes.x() == semi_axes.y() && semi_axes.x() == semi_axes.z(); }
  double gauge(const Vec3& rest) const;         ///< f, in the body's frame
  Vec3 gauge_gradient(const Vec3& rest) const;  ///< of it; zero at the centre
  /// Distance of a place in space to first order: never more than the true one outside.
  double about(const Vec3& x) const;
  /// @param sharpest  largest curvature that is told
  BodyFace face(const Vec3& x, double sharpest) const;
  Vec3 on_surface(const Vec3& rest) const;  ///< close to a place of the body's frame
};

}  // namespace sluice
