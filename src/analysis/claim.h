#pragma once
/// Whether a statement about two designs holds, from repetitions with different seeds.
///
/// Both designs are run with the same seeds, hence with the same sequence of rocks, so that their results are
/// compared pair by pair. A statement needs five seeds at least.

#include <vector>

#include "analysis/confidence.h"

namespace sluice {

enum class ClaimKind {
  lower,  ///< the first design's result lies below the other's
  alike,  ///< the two differ by less than a margin
};

enum class ClaimVerdict {
  holds,           ///< within the 95 % limits
  does_not_hold,   ///< the opposite lies within them
  not_shown,       ///< the limits allow both
  too_few_values,  ///< fewer than five pairs
};
const char* word_of(ClaimVerdict verdict);  ///< "holds", "does not hold", "is not shown", "has too few seeds"

inline constexpr std::size_t fewest_seeds = 5;

struct ClaimResult {
  ClaimVerdict verdict = ClaimVerdict::too_few_values;
  Estimate difference;   ///< first less other, mean of the pairs
  double reference = 0;  ///< mean of the other, to which a margin refers
};

/// @param first, other  results by seed, in one order; NaN where a run has none: the pair is left out
/// @param margin  alike: largest difference, as a share of the other's mean
ClaimResult judge_claim(ClaimKind kind, const std::vector<double>& first, const std::vector<double>& other,
                        double margin);

}  // namespace sluice
