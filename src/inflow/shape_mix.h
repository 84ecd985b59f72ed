#pragma once
/// Which shapes the rocks of a feed have: a finite table, because contacts are dispatched by shape.

#include <vector>

#include "base/random.h"
#include "base/schema.h"
#include "dem/rock_shape.h"

namespace sluice {

enum class ShapeKind { sphere, superquadric };

/// One family of shapes: a share of the rock's mass.
struct ShapeClass {
  ShapeKind kind = ShapeKind::superquadric;
  double share = 1;                                ///< of the mass; shares are scaled to a sum of 1
  double elongation_low = 1, elongation_high = 1;  ///< long over middle axis
  double flatness_low = 1, flatness_high = 1;      ///< short over middle axis
  std::vector<double> blockiness{2};               ///< exponents, equally frequent
  void keys(Schema& s);
};

/// Keys under `shapes:` of a feed or a fill; no class = spheres.
struct ShapeMixConfig {
  std::vector<ShapeClass> classes;
  std::int64_t steps = 3;  ///< values that stand for a range of elongation or flatness
  void keys(Schema& s);
};

/// Rows of the scene's shape table and how often each is drawn.
class ShapeMix {
 public:
  int draw(Random& random) const;                            ///< index in the scene's table
  double mean_volume() const { return mean_volume_; }        ///< by number, of rocks of size 1 [m3]
  double largest_radius() const { return largest_radius_; }  ///< bounding, of rocks of size 1 [m]
  std::size_t count() const { return index_.size(); }

 private:
  friend ShapeMix make_shape_mix(const ShapeMixConfig& config, std::vector<RockShape>& table);
  std::vector<int> index_;
  std::vector<double> cumulative_;  ///< by number, ends at 1
  double mean_volume_ = 0, largest_radius_ = 0;
};

/// Appends the shapes of the mix to the scene's table. A share is of the mass; the frequency by number is
/// share over volume.
ShapeMix make_shape_mix(const ShapeMixConfig& config, std::vector<RockShape>& table);

}  // namespace sluice
