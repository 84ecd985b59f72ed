#pragma once
/// Explicit, weakly compressible material point method on a sparse grid of blocks.

#include <memory>

#include "base/schema.h"
#include "fluid/fluid_system.h"
#include "geometry/wall.h"

namespace sluice {

enum class WallSlip { slip, no_slip, turbulent_film };
enum class Precision { single, reference };

/// Keys under `water:` of a process file.
struct MpmConfig {
  double spacing = 0;  ///< grid spacing h [m]
  std::int64_t points_per_cell_axis = 2;
  double fastest_bulk_speed = 5;      ///< of water in bulk, sprays apart [m/s]; sound speed is 10 times this
  double fastest_speed = 0;           ///< of any water, sprays included; 0 = the bulk speed [m/s]
  double deepest = 0;                 ///< head of standing water, for the sound speed [m]
  std::optional<double> sound_speed;  ///< instead of the rule [m/s]
  double courant = 0.3;               ///< dt (c + v) / h
  WallSlip wall_slip = WallSlip::turbulent_film;
  double film_friction = 0.025;  ///< Darcy f of the turbulent film stress rho f/8 |u| u
  Precision precision = Precision::single;
  bool keep_tension = false;  ///< keep negative pressure (closed periodic cases only)
  FluidModel fluid;
  void keys(Schema& s);
};

/// @param walls  must outlive the system
std::unique_ptr<FluidSystem> make_mpm(const MpmConfig& config, const Domain& domain, const Vec3& gravity,
                                      const Walls& walls);

}  // namespace sluice
