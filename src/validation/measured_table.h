#pragma once
/// Published curves and experiments. They are not carried here but read where they lie: in the folder that
/// SLUICE_REFERENCE_DATA names, else in ../shared/reference-data, below `measured`.

#include <optional>
#include <string>

#include "output/csv.h"

namespace sluice {

/// Lines that begin with # tell where the data come from and are left out. Nothing where no folder is.
/// @throws EnvironmentError where SLUICE_REFERENCE_DATA names a folder that lacks the file
std::optional<CsvTable> measured_table(const std::string& file);

/// What a case says that had to do without.
std::string without_table(const std::string& file);

}  // namespace sluice
