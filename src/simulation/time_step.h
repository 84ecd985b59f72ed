#pragma once
/// The step of the whole scene, fixed for the run: how often rock and water meet, and how many
/// substeps each takes in between.

#include "simulation/parts.h"

namespace sluice {

struct TimeStep {
  double dt = 0;           ///< of the scene: inflow, coupling, exits [s]
  int rock_substeps = 0;   ///< 0 without rocks
  int fluid_substeps = 0;  ///< 0 without water
  double dt_rock() const { return rock_substeps > 0 ? dt / rock_substeps : 0; }
  double dt_fluid() const { return fluid_substeps > 0 ? dt / fluid_substeps : 0; }
};

/// Longest scene step of a dry scene [s]: feed and exits are looked after at least this often.
inline constexpr double longest_dry_step = 1e-3;

/// Fluid steps between two looks at the exits: at half a cell each, water that leaves through an open face is
/// still on the grid, whose margin is three cells.
inline constexpr int most_fluid_substeps = 6;

/// From the limits of the systems present: the larger of the two steps, with the other one subcycled.
/// @pre at least one of rocks and water is there
TimeStep choose_time_step(const Parts& parts);

}  // namespace sluice
