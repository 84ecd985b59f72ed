#pragma once
/// A made-up run folder with everything a page can show: rocks that slide down a chute with water.

#include <filesystem>

namespace sluice {

enum class SampleScene { wet, dry };

/// Writes run.json, the tables, the series and view.json into the folder (no report.html).
/// @param seed  changes the numbers a little, for comparisons
void write_sample_run(const std::filesystem::path& folder, SampleScene scene, int seed = 1);

}  // namespace sluice
