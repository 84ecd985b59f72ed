#pragma once
/// Whether the motions of a process' walls make sense, and what the user should know of them.

#include <span>

#include "processes/process_config.h"

namespace sluice {

/// Steps that a period, a turn or the time between two keyframes must have: a sine's chords are then within
/// 0.2 % of its amplitude for the rocks, which bounce, and within 1.2 % for the water.
inline constexpr double least_rock_steps_per_period = 50, least_water_steps_per_period = 20;

/// Problems of one entry's motion: it leaves the domain.
/// @param walls  that the entry made
std::vector<InputProblem> motion_problems(const ProcessConfig& config, const WallConfig& entry,
                                          std::span<const Wall> walls);
/// Motions that the steps [s] of the rocks and of the water, 0 where there are none, do not resolve.
std::vector<InputProblem> unresolved_motions(const ProcessConfig& config, double rock_step,
                                             double water_step);
/// Walls that reach out of the domain as they move, or move faster than `rocks.impact_speed` or
/// `water.fastest_bulk_speed`.
std::vector<std::string> motion_warnings(const ProcessConfig& config, std::span<const Wall> walls);

}  // namespace sluice
