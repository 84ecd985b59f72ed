#pragma once
/// Runs a case up its ladder: error against run time.

#include <functional>

#include "output/validation_record.h"
#include "validation/case.h"

namespace sluice {

enum class LadderExtent { whole, quick };

struct LadderOptions {
  LadderExtent extent = LadderExtent::whole;
  std::string only;                     ///< one rung, by its setting; "" = as `extent` says
  std::vector<std::string> scene_keys;  ///< further "key=value" of the scene, on every rung
  /// Called after each rung.
  std::function<void(const ValidationCase&, const ValidationRung&)> told = {};
};

/// @throws InputError where `only` names no rung
ValidationCase run_ladder(const Case& what, const LadderOptions& options);

/// Exponent p of error ~ fineness^-p by least squares over the rungs whose error is above 0; positive
/// where the error falls from the first rung to the last. Absent for fewer than two.
std::optional<double> observed_order(const std::vector<double>& settings, const std::vector<double>& errors);

}  // namespace sluice
