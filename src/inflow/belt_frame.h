#pragma once
/// Directions and edges of the band in which a conveyor is loaded.
///
///        up                 The band reaches upstream from the front edge, burden_width wide.
///         |   __________
///   back  |  /         /  front --> along (belt speed)
///            ---------
///              across

#include "base/vec.h"

namespace sluice {

struct BeltFrame {
  Vec3 front = Vec3::Zero();  ///< middle of the front edge, offset included, on the belt [m]
  Vec3 along = Vec3::UnitX(), across = Vec3::UnitY(), up = Vec3::UnitZ();
  double speed = 0;   ///< [m/s]
  double width = 0;   ///< of the burden [m]
  double length = 0;  ///< of the band [m]

  /// A point of the band: `a` [m] behind the front edge, `b` [m] across from the middle, `c` [m] up.
  Vec3 at(double a, double b, double c) const { return front - a * along + b * across + c * up; }
};

}  // namespace sluice
