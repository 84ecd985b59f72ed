#pragma once
/// A process as it was read: its configuration and what identifies it.

#include <filesystem>
#include <string>
#include <vector>

#include "processes/process_config.h"

namespace sluice {

struct ProcessSource {
  ProcessConfig config;
  std::filesystem::path file;
  std::string sha256;  ///< over the file, what it extends, and the overrides; `--until` is no part of it
};

ProcessSource read_process_source(const std::filesystem::path& file,
                                  const std::vector<std::string>& overrides);

/// When a run ends [s]: at `until`, or the process's duration where that is empty.
/// @throws InputError  not a time
double end_of_run(const ProcessConfig& config, const std::string& until);

std::string program_name();  ///< "sluice 0.1.0 (commit)"

}  // namespace sluice
