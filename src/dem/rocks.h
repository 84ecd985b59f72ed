#pragma once
/// Rocks as structure of arrays. No loops here; DemSystem owns them and keeps the arrays alike. It sorts them
/// in space from time to time: what lasts longer than a step goes by id, not by index.

#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace sluice {

struct Rocks {
  std::vector<std::uint64_t> id;  ///< never used twice in a run; rocks change places now and then
  std::vector<Vec3> x;            ///< centre [m]
  std::vector<Vec3> v;            ///< [m/s]
  std::vector<Vec3> w;            ///< angular velocity, space frame [rad/s]
  std::vector<Quat> q;            ///< body to space, unit; a sphere keeps the one it came with
  std::vector<int> shape;         ///< index of DemSystem::shapes()
  std::vector<int> material;      ///< index of the scene's materials
  std::vector<int> source;        ///< index of the feed that made it
  std::vector<double> size;       ///< passing size [m]
  std::vector<double> mass;       ///< [kg]
  std::vector<double> radius;     ///< bounding radius [m]
  std::vector<double> birth;      ///< when it entered [s]
  std::vector<double> wet_dose;   ///< water met: integral of wetted fraction over time [s]
  std::vector<double> wetted;     ///< share in water at the last exchange [0..1]; 0 in a dry scene

  std::size_t count() const { return id.size(); }
};

struct NewRock {
  Vec3 x = Vec3::Zero();
  Vec3 v = Vec3::Zero();
  Vec3 w = Vec3::Zero();
  Quat q = Quat::Identity();
  int shape = 0;
  int material = 0;
  int source = 0;
  double size = 0;
};

}  // namespace sluice
