#pragma once
/// Runs extreme cases rung by rung, as `sluice run` would, and finds where they break.

#include <functional>
#include <optional>

#include "validation/extreme_case.h"

namespace sluice {

struct ExtremeOptions {
  bool quick = false;
  std::string only;  ///< one rung, by its setting; "" = all
  std::function<void(const ExtremeCase&, const ExtremeRung&)> told = {};
};

/// @throws InputError where `only` names no rung
ExtremeCase run_extreme(const Extreme& what, const ExtremeOptions& options);

/// Particle steps at which a rung is cut short, so that none takes longer than some ten seconds on one core;
/// of `--quick`, one or two.
inline constexpr double most_particle_steps = 1.5e7, quick_particle_steps = 2e6;

struct HardRun {
  std::filesystem::path process;
  std::vector<std::string> overrides;
  std::optional<double> step_share;  ///< step over the critical step; none: the step that a user gets
  double particle_steps = most_particle_steps;
};

/// One run of a process, as `sluice run` would, and cut short. Catches what a run may do and reports it; what
/// it may not do is `broken`.
ExtremeRung run_hard(const HardRun& run);

}  // namespace sluice
