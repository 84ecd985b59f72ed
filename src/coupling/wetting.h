#pragma once
/// Which share of a rock stands in water: points spread through its volume, each of which asks the
/// fluid node next to it how full it is. A dry rock above a wet sheet has no wet point.

#include <span>
#include <vector>

#include "dem/dem_system.h"
#include "fluid/fluid_system.h"

namespace sluice {

/// Below this fill a node wets nothing: the tail of the fluid's kernel above a level surface.
inline constexpr double dry_fill = 0.05;

/// Points inside a shape, in units of the size, evenly spread by volume.
struct WettingPoints {
  std::vector<float> x, y, z;
  std::size_t count() const { return x.size(); }
};
std::vector<WettingPoints> wetting_points(const std::vector<RockShape>& shapes, int per_rock);
/// The same on the surface, evenly spread by area.
std::vector<WettingPoints> skin_points(const std::vector<RockShape>& shapes, int per_rock);

/// How much each cell around a fluid node wets: a dense table over the domain at the fluid's spacing, so that
/// a rock's points are looked up side by side.
class FillTable {
 public:
  FillTable(const Domain& domain, double spacing);
  /// @param fill  of the space that is open to the fluid, #nodes
  void set(const FluidNodes& nodes, std::span<const double> fill);
  /// Mean over the points of what their cells wet, min(1, fill) [0..1].
  /// @param turn  body to space, times the rock's size [m];  reach  bounding radius [m]
  double wetted_fraction(const WettingPoints& points, const Vec3& centre, const Mat3& turn,
                         double reach) const;
  std::size_t memory_bytes() const {
    return table_.capacity() * sizeof(float) + filled_.capacity() * sizeof(int);
  }

 private:
  int slot(int i, int j, int k) const;  ///< -1 outside
  Domain domain_;
  double spacing_;
  Vec3 origin_ = Vec3::Zero();
  Vec3i cells_ = Vec3i::Zero(), period_ = Vec3i::Zero();
  std::vector<float> table_;
  std::vector<int> filled_;
};

}  // namespace sluice
