#pragma once
/// A process over a ladder of one key: what a finer rung changes, and what it costs.

#include <filesystem>
#include <string>

#include "output/run_series.h"

namespace sluice {

std::string converge_html(const ConvergeRecord& record);
/// The headline results as a table for a terminal, then the sentences.
std::string converge_text(const ConvergeRecord& record);

/// converge.html, .json and .csv. @throws EnvironmentError
void write_converge_page(const std::filesystem::path& folder, const ConvergeRecord& record);

}  // namespace sluice
