#pragma once
/// What can be known of a run's trouble before its first step: settings that will make it slow, wrong or
/// stop.

#include <string>
#include <vector>

#include "processes/process_config.h"
#include "simulation/parts.h"

namespace sluice {

/// One sentence each, with the figure and the key to turn; empty where nothing is to be feared.
/// @param parts  built from `config`, filled
std::vector<std::string> foreseen(const ProcessConfig& config, const Parts& parts);

}  // namespace sluice
