#pragma once
/// The nodes that walls hide from a point, in groups. Whatever is linear in a node's distance d from the
/// point needs only the moments of the nodes' weights: a group counts as one node.

#include <bit>
#include <cstdint>
#include <span>

#include "mpm/point_store.h"
#include "mpm/spline_weights.h"
#include "mpm/wall_field.h"
#include "mpm/wall_sight.h"

namespace sluice {

constexpr int most_planes = 6;  ///< that act on one point

/// Hidden nodes that the same wall hides from a point in the same way.
struct HiddenNodes {
  std::uint32_t mirrors;  ///< bits of the planes at which the point's field is mirrored
  std::uint32_t between;  ///< bits of the planes between the point and them
  int wall;               ///< that hides them
  double w;               ///< sum of the weights
  double first[3];        ///< sum w d [cells]
  double second[6];       ///< sum w d d^T as xx yy zz yz xz xy [cells2]

  Vec3 d() const { return {first[0], first[1], first[2]}; }
  Mat3 dd() const {
    Mat3 m;
    m << second[0], second[5], second[4], second[5], second[1], second[3], second[4], second[3], second[2];
    return m;
  }
};

struct HiddenGroups {
  HiddenNodes group[27];  ///< of which `count` are written
  int count;
  HiddenGroups() : count(0) {}
  std::span<const HiddenNodes> all() const { return {group, static_cast<std::size_t>(count)}; }
};

/// What stands around a point near walls.
struct Surroundings {
  const WallField& field;
  double h = 0;
  Vec3 x = Vec3::Zero();  ///< of the point [m]
  Visibility seen{};
  WallPlane planes[most_planes]{};
  int plane_count = 0;
};

/// @param offset  of the point from its nearest node [cells]
/// @param holds  bits of the planes that hold the point: it does not leave them freely
void group_hidden(const Surroundings& around, const Vec3& offset, std::uint32_t holds, HiddenGroups& out);

}  // namespace sluice
