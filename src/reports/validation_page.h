#pragma once
/// One page for all validation cases: error against run time, pass or fail.

#include <filesystem>
#include <string>

#include "output/validation_record.h"

namespace sluice {

std::string validation_html(const ValidationRecord& record);
std::string validation_markdown(const ValidationRecord& record);

/// Writes validation.html, validation.md and validation.json into a folder, which is made if needed.
/// @throws EnvironmentError
void write_validation_page(const std::filesystem::path& folder, const ValidationRecord& record);

}  // namespace sluice
