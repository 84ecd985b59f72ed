#pragma once
/// One impact of an elastic sphere under Hertz-Mindlin, without gravity.

#include <vector>

#include "validation/rock_scenes.h"

namespace sluice {

struct ImpactSphere {
  Material material;
  double radius = 0;  ///< [m]
  double friction = 0, restitution = 1;
  Tangential tangential = Tangential::rescaled;
};

enum class ImpactAgainst {
  plane,  ///< rigid
  twin,   ///< an equal sphere that comes as fast the other way
};

/// The course of an impact; the force is the change of momentum in a step, told for its middle.
struct Impact {
  std::vector<double> t;        ///< since first touch [s]
  std::vector<double> overlap;  ///< [m]
  std::vector<double> force;    ///< along the normal [N]
  double contact_time = 0;      ///< [s]
  Vec3 v, w;                    ///< of the sphere after it [m/s], [rad/s]
  double rock_steps = 0;
};

/// @param v  of the sphere [m/s]; what it meets lies below: v.z() < 0
/// @param steps_per_contact  of a contact at that speed
/// @throws NumericalError if the contact does not end
Impact impact_of(const ImpactSphere& sphere, const Vec3& v, ImpactAgainst against, double steps_per_contact);

}  // namespace sluice
