#pragma once
/// Vectors, rotations and boxes. Double precision, SI units.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <limits>

namespace sluice {

using Vec3 = Eigen::Vector3d;
using Vec3f = Eigen::Vector3f;
using Vec3i = Eigen::Vector3i;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;  ///< body to space

/// Axis-aligned box [m]; empty until something is put in.
struct Box {
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 hi = Vec3::Constant(-std::numeric_limits<double>::infinity());

  bool empty() const { return (lo.array() > hi.array()).any(); }
  bool contains(const Vec3& x) const {
    return (x.array() >= lo.array()).all() && (x.array() <= hi.array()).all();
  }
  Vec3 size() const { return hi - lo; }
  Vec3 centre() const { return 0.5 * (lo + hi); }
  void include(const Vec3& x) {
    lo = lo.cwiseMin(x);
    hi = hi.cwiseMax(x);
  }
  void include(const Box& other) {
    lo = lo.cwiseMin(other.lo);
    hi = hi.cwiseMax(other.hi);
  }
  Box grown(double by) const { return {lo - Vec3::Constant(by), hi + Vec3::Constant(by)}; }
  bool overlaps(const Box& other) const {
    return (lo.array() <= other.hi.array()).all() && (other.lo.array() <= hi.array()).all();
  }
};

/// Two unit vectors that make a right-handed frame with the unit vector n: {e1, e2}, e1 x e2 = n.
std::array<Vec3, 2> tangent_frame(const Vec3& n);

}  // namespace sluice
