#pragma once
/// From a process file's configuration to the parts of a simulation.

#include "processes/process_config.h"
#include "simulation/parts.h"

namespace sluice {

/// Walls of the process, one per CAD part, then the walled faces of the domain.
/// @throws InputError with places: damaged or missing CAD, unknown part or material, repeated names
std::vector<Wall> build_walls(const ProcessConfig& config);

/// The table of materials with all pairs; pairs that cannot touch need no contact.
Materials build_materials(const ProcessConfig& config);

struct BuiltProcess {
  Parts parts;
  std::vector<std::string> warnings;  ///< what the user should know before running
  double rock_rate = 0;               ///< that the feeds ask for, fines apart [kg/s]
};

/// Everything, filled and ready for the first step.
/// @throws InputError with everything that does not fit together
BuiltProcess build_parts(const ProcessConfig& config);

}  // namespace sluice
