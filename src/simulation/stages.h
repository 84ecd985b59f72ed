#pragma once
/// The step as a list of named stages, one timer each. It reads as the algorithm and holds only what
/// the scene has:
///
///   dry:  inflow  rocks.substeps  exits  probes
///   wet:  inflow  coupling.solids_to_grid  water.points_to_grid  coupling.drag  water.walls
///         water.grid_to_points  coupling.fluid_to_grid  rocks.substeps  exits  probes
///
/// The order is that of Sinnott & Cleary (2017), section 2.1. Drag is
/// evaluated once, in coupling.drag, and handed to both sides; coupling.fluid_to_grid averages the
/// acceleration that the fluid really had, walls included, for the buoyancy.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "simulation/parts.h"
#include "simulation/time_step.h"

namespace sluice {

struct StepSpan {
  double t = 0;   ///< at the start of the step [s]
  double dt = 0;  ///< [s]
};

struct Stage {
  std::string name;
  std::function<void(const StepSpan&)> run;
  double seconds = 0;
  std::uint64_t calls = 0;
};

/// @param parts  must outlive the stages
std::vector<Stage> build_stages(Parts& parts, const TimeStep& step);

}  // namespace sluice
