#pragma once
/// Beds of rock for the benchmarks and for their peers: dense, random, pressed together and in gentle flow.
///
/// A bed is a periodic box without gravity. A cell of it is filled at random, the largest rocks first, and
/// shrinks in stages, rocks at rest again after each, until they carry one another with as many contacts
/// as asked; copies of the cell fill the box, and a velocity v_x = V sin(2 pi z / L) shears it.

#include <array>
#include <vector>

#include "dem/dem_system.h"

namespace sluice::speed {

inline constexpr double density = 2700;              ///< [kg/m3]
inline constexpr double restitution = 0.3;           ///< of all pairs
inline constexpr double friction = 0.5;              ///< of all pairs
inline constexpr double stiffness_per_size = 4e6;    ///< [N/m2]; 0.5 % mean overlap under 0.7 m of rock
inline constexpr double tangential_ratio = 2.0 / 7;  ///< k_t / k_n
inline constexpr double shear_speed = 0.5;           ///< V [m/s]

struct BedRecipe {
  RockShape shape = make_sphere();
  std::vector<double> sizes;           ///< of a cell's rocks [m]
  std::array<int, 3> copies{1, 1, 1};  ///< of the cell along each axis
  double first_fraction = 0.3;         ///< of solids, before the cell shrinks
  double first_shrink = 0.01;          ///< of the cell per stage, while it is loose
  double coordination = 5;             ///< contacts of a rock at which it stops
  int steps_per_stage = 40;
  std::size_t keep = 0;        ///< spheres kept after the shut-in ones are taken out; 0 = take none out
  double overlap_limit = 0.3;  ///< of the radius, at which a run stops
};

struct Bed {
  RockShape shape;
  Domain domain;
  double smallest = 0, largest = 0;  ///< size [m]
  std::vector<NewRock> rocks;
};

Bed make_bed(const BedRecipe& recipe);

/// 200 000 spheres of 20 mm.
BedRecipe dense_200k();
/// 50 000 spheres, radii uniform by number from 2 to 10 mm.
BedRecipe poly5_50k();
/// 50 000 spheres, sizes from 2 to 100 mm by mass as Gates, Gaudin and Schuhmann: passing (d/d_max)^0.7.
BedRecipe poly50_50k();
/// 30 000 superquadrics of 10 mm (middle axis).
BedRecipe superquadrics_30k(const RockShape& shape);

DemScene scene_of(const Bed& bed);
DemConfig config_of_beds();
/// @param dem  made of scene_of(bed)
void add_rocks(const Bed& bed, DemSystem& dem);

}  // namespace sluice::speed
