#pragma once
/// Variations of a process beside each other: what is claimed of them, their results with limits over the
/// seeds, and the comparison of their first runs.

#include <filesystem>
#include <string>

#include "output/run_series.h"

namespace sluice {

/// "Sprays distribute water more uniformly than pipes: holds. At sprays it is ..., at pipes ...; seed by seed
/// ..."
std::string claim_sentence(const StudyRecord& record, const StudyClaim& claim);
std::string study_html(const StudyRecord& record);
/// Headline results as a table for a terminal, then the claims.
std::string study_text(const StudyRecord& record);

/// study.html, .json and .csv. @throws EnvironmentError
void write_study_page(const std::filesystem::path& folder, const StudyRecord& record);

}  // namespace sluice
