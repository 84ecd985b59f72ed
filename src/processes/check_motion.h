#pragma once
/// Whether the motions of a process' walls make sense, and what the user should know of them.

#include <span>

#include "processes/process_config.h"

namespace sluice {

/// Rock steps that a period, a turn or the time between two keyframes must have. Fifty: a sine's chords
/// are then within 0.2 % of its amplitude.
inline constexpr double least_steps_per_period = 50;

/// Problems of one entry's motion: water would not see it, or it leaves the domain.
/// @param walls  that the entry made
std::vector<InputProblem> motion_problems(const ProcessConfig& config, const WallConfig& entry,
                                          std::span<const Wall> walls);
/// Motions that the rocks' step [s] does not resolve.
std::vector<InputProblem> unresolved_motions(const ProcessConfig& config, double step);
/// Walls that reach out of the domain as they move, or move faster than `rocks.impact_speed`.
std::vector<std::string> motion_warnings(const ProcessConfig& config, std::span<const Wall> walls);

}  // namespace sluice
