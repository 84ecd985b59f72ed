#pragma once
/// What a ladder says, in sentences.

#include <string>
#include <vector>

#include "output/run_series.h"

namespace sluice {

/// "0.21 \u00b1 0.02 t/h" in the result's shown unit; limits only where the average is steady.
std::string shown(const KeyResult& result, double value, double half_width);

/// Headline results that some rung has and that are not 0 throughout, in order.
std::vector<KeyResult> headline_results(const std::vector<SeriesRow>& rows,
                                        const std::vector<KeyResult>& all);

/// What the step from one rung to the next did to a result, in words: "changes it by 0.01 \u00b1 0.03: no
/// more than chance, below 0.04".
std::string change_words(const ConvergeRecord& record, std::size_t rung, const KeyResult& result);

/// "At 20 mm the unevenness of water is 0.21 \u00b1 0.02 and costs 14 min; 10 mm costs 3 h 6 min and changes
/// it by ..." of the last two rungs.
std::string ladder_sentence(const ConvergeRecord& record, const KeyResult& result);

}  // namespace sluice
