#pragma once
/// What a ladder of ever finer settings says about one result, where each rung knows its result only within
/// sampling limits.
///
/// A chaotic flow never repeats, so a difference between rungs counts only beyond the limits of both. An
/// order and an extrapolated error (grid convergence index, Roache 1994; unequal ratios as Celik et al. 2008)
/// are given where the last differences are at least three times their limits; otherwise the change alone, or
/// a bound on it.

#include <optional>
#include <string>
#include <vector>

namespace sluice {

struct LadderPoint {
  double setting = 0;     ///< of the varied key, SI; NaN where it is a word
  double value = 0;       ///< NaN where the rung has none
  double half_width = 0;  ///< of its 95 % limits; NaN where there are none
};

enum class ChangeVerdict {
  resolved,   ///< beyond three times its limits
  changed,    ///< beyond its limits
  bounded,    ///< not beyond its limits, and with them it is at most a quarter of the value
  too_short,  ///< not beyond its limits, and with them more: the sampling is too short to tell
  unknown,    ///< a value or its limits are missing
};
/// "resolved", "changed", "bounded", "too_short", "unknown"
const char* word_of(ChangeVerdict verdict);

/// From one rung to the next.
struct Change {
  double value = 0;       ///< NaN where a value is missing
  double half_width = 0;  ///< of its 95 % limits, the two rungs taken as independent
  ChangeVerdict verdict = ChangeVerdict::unknown;
};
Change change_between(const LadderPoint& coarse, const LadderPoint& fine);

/// Of the last three rungs.
struct Extrapolation {
  double order = 0;
  double value = 0;  ///< at infinite resolution
  double index = 0;  ///< grid convergence index of the last rung: a bound on its error, in the result's unit
};

/// None where a rung lacks a number, the settings do not run one way, a difference is not resolved, the
/// result does not run one way, or the order is outside 0.5 .. 3. An order above 2, that of the schemes,
/// counts as 2.
/// @param points  coarse to fine; where the setting grows, finer means larger (stiffness, steps per contact)
std::optional<Extrapolation> extrapolate(const std::vector<LadderPoint>& points);

}  // namespace sluice
