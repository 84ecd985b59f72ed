#pragma once
/// Shapes of rocks, in units of the rock's size.
///
/// A rock is a shape times its `size`, which is its passing size: twice the middle semi-axis, what a
/// square sieve measures on a stone that turns freely. Shapes live in a table; rocks hold an index.

#include <vector>

#include "base/vec.h"

namespace sluice {

/// Superquadric |x/a|^m + |y/b|^m + |z/c|^m = 1; a sphere is a = b = c, m = 2.
struct RockShape {
  Vec3 semi_axes = Vec3::Constant(0.5);  ///< a >= b >= c in units of the size; b = 0.5
  double blockiness = 2;                 ///< m, 2 = ellipsoid, large = box
  double volume = 0;                     ///< of a rock of size 1 [m3]
  Vec3 inertia = Vec3::Zero();           ///< about the body axes, per mass, of a rock of size 1 [m2]
  double bounding_radius = 0;            ///< of a rock of size 1 [m]
  double surface = 0;                    ///< area of a rock of size 1 [m2]
  double sphericity = 1;                 ///< area of the equal-volume sphere over the area

  bool is_sphere() const {
    return blockiness == 2 && semi_axes.x() == semi_axes.y() && semi_axes.y() == semi_axes.z();
  }
};

RockShape make_sphere();
/// @param elongation  a/b >= 1;  @param flatness  c/b in (0, 1];  @param blockiness  m >= 2
/// Volume, inertia: Jaklic et al. (2000); see physics.md for the closed forms.
RockShape make_superquadric(double elongation, double flatness, double blockiness);

/// Volume [m3]: 8 a b c G(1 + 1/m)^3 / G(1 + 3/m).
double superquadric_volume(const Vec3& semi_axes, double m);
/// Principal inertia per mass [m2]: kappa (b^2 + c^2) and so on, kappa = G(3/m) G(1 + 3/m) / (G(1/m) G(1 +
/// 5/m)).
Vec3 superquadric_inertia(const Vec3& semi_axes, double m);
/// Radius of the smallest sphere about the centre that holds the body [m].
double superquadric_bounding_radius(const Vec3& semi_axes, double m);
/// Surface area [m2] by Gauss-Legendre quadrature, relative error below 1e-8 for m from 2 to 32.
double superquadric_area(const Vec3& semi_axes, double m);

/// Support function h(n) [m] of semi-axes a [m] and blockiness m along the body-frame unit vector n.
double support_height(const Vec3& semi_axes, double m, const Vec3& n_body);
/// Support point: the surface point farthest along n (body frame) [m].
Vec3 support_point(const Vec3& semi_axes, double m, const Vec3& n_body);
/// |x/a|^m + |y/b|^m + |z/c|^m; below 1 inside.
double superquadric_function(const Vec3& semi_axes, double m, const Vec3& x_body);

/// n points [m] of the surface (body frame), spread so that each stands for about the same area:
/// farthest-point sampling of a dense spiral, the same for every call.
std::vector<Vec3> surface_points(const Vec3& semi_axes, double m, int n);

}  // namespace sluice
