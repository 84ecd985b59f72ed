#pragma once
/// Determinants with an exact sign: a floating-point filter, and expansions where it cannot tell.
/// Shewchuk (1997), Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates.

#include "base/vec.h"

namespace sluice {

/// (b - a) . ((c - a) x (d - a)), six times the signed volume of a tetrahedron; its sign is exact.
double orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// (b - a) x (c - a), twice the signed area of a triangle in the plane; its sign is exact.
double orient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

}  // namespace sluice
