#include "validation/measured_table.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "base/errors.h"

namespace sluice {

namespace fs = std::filesystem;

std::optional<CsvTable> measured_table(const std::string& file) {
  const char* named = std::getenv("SLUICE_REFERENCE_DATA");
  const fs::path path = fs::path(named ? named : "../shared/reference-data") / "measured" / file;
  std::ifstream in(path);
  if (!in && named)
    throw EnvironmentError(
        fmt::format("{} cannot be read; SLUICE_REFERENCE_DATA names a folder without it", path.string()));
  if (!in) return std::nullopt;
  std::ostringstream rows;
  for (std::string line; std::getline(in, line);)
    if (!line.starts_with('#')) rows << line << '\n';
  return parse_csv(rows.str(), path);
}

std::string without_table(const std::string& file) {
  return fmt::format("without {}, which is not there (SLUICE_REFERENCE_DATA): only the headline figures",
                     file);
}

}  // namespace sluice
