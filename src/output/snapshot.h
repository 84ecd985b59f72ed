#pragma once
/// What frames, view and pictures show of one moment: plain arrays, copied out of the systems.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"
#include "dem/dem_system.h"
#include "fluid/fluid_system.h"
#include "geometry/wall.h"

namespace sluice {

struct RockSnapshot {
  std::vector<std::uint64_t> id;
  std::vector<Vec3> x;             ///< [m]
  std::vector<Vec3> v;             ///< [m/s]
  std::vector<Quat> q;             ///< body to space
  std::vector<Vec3> semi_axes;     ///< [m]
  std::vector<double> blockiness;  ///< m of the superquadric
  std::vector<double> size;        ///< passing size [m]
  std::vector<double> mass;        ///< [kg]
  std::vector<double> wetted;      ///< wetted fraction 0..1; 0 in a dry scene
  std::vector<int> shape;          ///< index of the shape table

  std::size_t count() const { return id.size(); }
};

RockSnapshot snapshot_rocks(const DemSystem& rocks);

/// One moment. An absent phase is nullopt; walls may be null.
struct Snapshot {
  double time = 0;  ///< [s]
  Vec3 up = Vec3::UnitZ();
  std::optional<RockSnapshot> rocks;
  std::optional<WaterPoints> water;
  double water_point_volume = 0;  ///< at rest [m3]
  const std::vector<Wall>* walls = nullptr;
};

/// @param gravity  gives `up` [m/s2];  null systems are absent phases
Snapshot take_snapshot(double time, const Vec3& gravity, const DemSystem* rocks, const FluidSystem* water,
                       const Walls& walls);

}  // namespace sluice
