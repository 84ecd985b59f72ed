#include "simulation/time_step.h"

#include <algorithm>
#include <cmath>

namespace sluice {

TimeStep choose_time_step(const Parts& parts) {
  // A ratio that is whole but for rounding must not cost a substep.
  const auto steps = [](double ratio) { return std::max(1, static_cast<int>(std::ceil(ratio - 1e-9))); };
  TimeStep step;
  const double rock = parts.rocks ? parts.rocks->step_size() : 0;
  const double fluid = parts.water ? parts.water->limits().step : 0;
  if (!parts.water) {
    step.rock_substeps = std::max(1, static_cast<int>(std::floor(longest_dry_step / rock)));
    step.dt = step.rock_substeps * rock;
  } else if (!parts.rocks) {
    step.fluid_substeps = 1;
    step.dt = fluid;
  } else {
    step.dt = std::min(std::max(rock, fluid), most_fluid_substeps * fluid);
    step.rock_substeps = steps(step.dt / rock);
    step.fluid_substeps = steps(step.dt / fluid);
  }
  return step;
}

}  // namespace sluice
