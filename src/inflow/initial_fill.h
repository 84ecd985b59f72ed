#pragma once
/// What is there when the run begins: standing water and packed rock.

#include <optional>
#include <string>

#include "geometry/wall.h"
#include "inflow/inflow.h"
#include "inflow/shape_mix.h"
#include "inflow/size_distribution.h"

namespace sluice {

/// Keys under `initial: water: NAME:`. Water fills a box up to a level.
struct WaterFillConfig {
  std::string name;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< corners of the box [m]
  std::optional<double> level;                   ///< height of the surface, if below the box's top [m]
  std::string inside;                            ///< closed wall part; only what lies inside it is filled
  Vec3 velocity = Vec3::Zero();                  ///< [m/s]
  bool hydrostatic = true;                       ///< start under its own weight
  double jitter = 0;                             ///< random displacement of the points, of their spacing
  double fines = 0;                              ///< volume fraction of fines in it
  Location where;
  void keys(Schema& s);
};

/// Keys under `initial: rocks: NAME:`. Rocks at random places of a box, none touching another.
struct RockFillConfig {
  std::string name;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< corners of the box [m]
  std::int64_t count = 0;                        ///< rocks, or
  std::optional<double> mass;                    ///< their mass [kg]
  std::string material;
  SizeDistributionConfig sizes;
  ShapeMixConfig shapes;
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
  Location where;
  void keys(Schema& s);
};

/// What a fill put in.
struct FilledMass {
  double mass = 0;               ///< as stored; water: fines included [kg]
  double fines = 0;              ///< water: of it fines [kg]
  Vec3 momentum = Vec3::Zero();  ///< [N s]
  std::size_t count = 0;         ///< rocks or points
};

/// Points on a lattice that fills the box exactly, so that the mass is density x volume. Under its own weight
/// the density follows the fluid's equation of state: J = exp(-g depth / c^2).
/// @throws InputError: no water, no such part, a box outside the domain, slurry too thick to flow
FilledMass fill_water(const WaterFillConfig& config, const Walls& walls, const InflowTarget& target);

/// @param mix  made from config.shapes for the shape table of the rocks' scene
/// @throws InputError: no rocks, unknown material, a box outside the domain, rocks that do not fit in it
FilledMass fill_rocks(const RockFillConfig& config, const ShapeMix& mix, const InflowTarget& target);

}  // namespace sluice
