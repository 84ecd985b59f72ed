#pragma once
/// What a process places in its domain must lie there: a part in millimetres that was read as metres, a
/// nozzle above the box or a gauge beside it would do nothing and say nothing.

#include "processes/process_config.h"

namespace sluice {

/// Pipes, sprays, gauges, mixing zones and the water's spacing; build_walls and check_exits see to the rest.
std::vector<InputProblem> misplaced(const ProcessConfig& config);

/// "[0, 0, 0] .. [1, 1, 2] m"
std::string reach_of(const Box& box);

}  // namespace sluice
