#pragma once
/// Fluid points as they cross the house: what is asked, added and removed. How a fluid method stores
/// them is its own affair.

#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace sluice {

/// A copy of the points for output, analysis and tests: structure of arrays, in ascending id.
struct WaterPoints {
  std::vector<std::uint64_t> id;
  std::vector<Vec3> x;             ///< [m]
  std::vector<Vec3> v;             ///< [m/s]
  std::vector<double> mass;        ///< [kg], water and fines
  std::vector<double> fines_mass;  ///< [kg] of it fines
  std::vector<double> J;           ///< volume over rest volume
  std::vector<double> pressure;    ///< [Pa]

  std::size_t count() const { return id.size(); }
};

struct NewPoint {
  Vec3 x = Vec3::Zero();
  Vec3 v = Vec3::Zero();
  double mass = 0;        ///< [kg], water and fines
  double fines_mass = 0;  ///< [kg]
  double J = 1;           ///< below 1 for an equilibrated start under pressure
};

struct RemovedPoint {
  std::uint64_t id = 0;
  Vec3 x = Vec3::Zero(), v = Vec3::Zero();
  double mass = 0, fines_mass = 0;
};

}  // namespace sluice
