#pragma once
/// report.html of one run.

#include <filesystem>

namespace sluice {

/// Reads what the run folder holds and writes report.html into it: one page that carries everything
/// with it. Works for a run that is going on, was interrupted or has failed, too.
/// @throws EnvironmentError  no run.json, or the disk;  InputError  a damaged file
void write_run_page(const std::filesystem::path& run_folder);

}  // namespace sluice
