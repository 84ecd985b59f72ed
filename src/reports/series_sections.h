#pragma once
/// Parts that the pages of series of runs share.

#include <string>
#include <vector>

#include "output/run_series.h"

namespace sluice {

enum class RowKind { rung, variation };
/// What each run was and cost.
std::string run_table(const std::vector<SeriesRow>& rows, RowKind kind);
std::string notes_list(const std::vector<std::string>& notes);
/// @param files  that hold the numbers, in words
std::string provenance_list(const SeriesProvenance& p, const std::string& files);

}  // namespace sluice
