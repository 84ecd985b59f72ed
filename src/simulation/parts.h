#pragma once
/// Everything a scene consists of. What it does not need is not there.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/exits.h"
#include "analysis/probe.h"
#include "coupling/coupling.h"
#include "dem/dem_system.h"
#include "fluid/fluid_system.h"
#include "geometry/wall.h"
#include "inflow/inflow.h"

namespace sluice {

struct Parts {
  Domain domain;
  Vec3 gravity = Vec3(0, 0, -9.81);                          ///< [m/s2]
  std::unique_ptr<Walls> walls = std::make_unique<Walls>();  ///< stays where it is: others point to it
  std::unique_ptr<DemSystem> rocks;
  std::unique_ptr<FluidSystem> water;
  std::unique_ptr<Coupling> coupling;  ///< only with rocks and water
  std::vector<std::unique_ptr<Inflow>> inflows;
  std::optional<Exits> exits;  ///< also counts `outside`
  std::vector<std::unique_ptr<Probe>> probes;
  double initial_rock_kg = 0, initial_water_kg = 0, initial_fines_kg = 0;

  /// Words for the run header: "rocks", "3 walls", "1 conveyor"; and what was left out.
  std::vector<std::string> present() const;
  std::vector<std::string> left_out() const;
};

}  // namespace sluice
