#pragma once
/// Runs extreme cases rung by rung, as `sluice run` would, and finds where they break.

#include <functional>

#include "validation/extreme_case.h"

namespace sluice {

struct ExtremeOptions {
  bool quick = false;
  std::string only;  ///< one rung, by its setting; "" = all
  std::function<void(const ExtremeCase&, const ExtremeRung&)> told = {};
};

/// @throws InputError where `only` names no rung
ExtremeCase run_extreme(const Extreme& what, const ExtremeOptions& options);

/// One run of a process with overrides, never longer than a number of particle steps. Catches what a run
/// may do and reports it; what it may not do is `broken`.
ExtremeRung run_hard(const std::filesystem::path& process, const std::vector<std::string>& overrides,
                     std::optional<double> step_share);

}  // namespace sluice
