#pragma once
/// One page for all extreme cases: how far each hard setting goes, and what happens beyond.

#include <filesystem>
#include <string>

#include "output/extremes_record.h"

namespace sluice {

std::string extremes_html(const ExtremesRecord& record);
std::string extremes_markdown(const ExtremesRecord& record);

/// Writes extremes.html and extremes.md into a folder, which is made if needed.
/// @throws EnvironmentError
void write_extremes_page(const std::filesystem::path& folder, const ExtremesRecord& record);

}  // namespace sluice
