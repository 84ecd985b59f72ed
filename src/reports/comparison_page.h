#pragma once
/// Several runs beside each other.

#include <filesystem>
#include <string>
#include <vector>

#include "reports/page_shell.h"

namespace sluice {

/// One page: what differs between the runs, their key numbers in a table, exit distributions laid over
/// each other, pictures side by side.
/// @param run_folders  two or more
/// @throws EnvironmentError  a run.json is missing, or the disk;  InputError  a damaged file
void write_comparison_page(const std::vector<std::filesystem::path>& run_folders,
                           const std::filesystem::path& out, const std::string& title = "Comparison of runs");

/// The same page, to be put together with other sections.
Page comparison_page(const std::vector<std::filesystem::path>& run_folders, const std::string& title);

}  // namespace sluice
