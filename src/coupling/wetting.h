#pragma once
/// Which share of a rock stands in water: points spread through its volume, each of which asks the
/// fluid node next to it how full it is. A dry rock above a wet sheet has no wet point.

#include <vector>

#include "dem/dem_system.h"
#include "fluid/fluid_system.h"

namespace sluice {

/// Finds the fluid node nearest to a place: a dense table over the domain at the fluid's spacing.
class NodeTable {
 public:
  NodeTable(const Domain& domain, double spacing);
  void set(const FluidNodes& nodes);
  int nearest(const Vec3& x) const;  ///< index of a node with mass, or -1
  std::size_t memory_bytes() const {
    return table_.capacity() * sizeof(int) + filled_.capacity() * sizeof(int);
  }

 private:
  int slot(const Vec3& x) const;
  Domain domain_;
  double spacing_;
  Vec3 origin_ = Vec3::Zero();
  Vec3i cells_ = Vec3i::Zero();
  std::vector<int> table_, filled_;
};

/// Points inside each shape of the table, in units of the size, evenly spread by volume.
std::vector<std::vector<Vec3>> wetting_points(const std::vector<RockShape>& shapes, int per_rock);

/// Below this fill a node wets nothing: the tail of the fluid's kernel above a level surface.
inline constexpr double dry_fill = 0.05;

/// Mean over the rock's points of min(1, fill) [0..1].
double wetted_fraction(const DemSystem& rocks, std::size_t rock, const std::vector<Vec3>& points,
                       const NodeTable& table, const FluidNodes& nodes);

}  // namespace sluice
