#pragma once
/// Exit figures of a run: over the steady part where there is one, else over the second half, which is
/// then said.

#include <string>
#include <vector>

#include "analysis/exit_distribution.h"
#include "simulation/simulation.h"

namespace sluice {

struct ExitResult {
  std::string name;
  ExitDistribution distribution;
  std::optional<double> steady_from;  ///< [s]
  std::string reason;                 ///< why there is no steady part; empty otherwise
};

/// One per exit, in configuration order.
std::vector<ExitResult> exit_results(const Simulation& simulation);

}  // namespace sluice
