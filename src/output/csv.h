#pragma once
/// Comma-separated tables (RFC 4180, lines end with a line feed alone): a header line with names and units
/// ("rock_kg_s"), then rows. Numbers are written so that they read back to the same double; a missing one is
/// an empty cell.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sluice {

/// A text, or a number; NaN and infinity are written as an empty cell.
using CsvCell = std::variant<double, std::string>;

struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<CsvCell>> rows;

  /// Appends a row. @pre as many cells as columns
  void add(std::vector<CsvCell> row);
  std::optional<std::size_t> find(std::string_view column) const;
  /// The column's numbers; NaN for an empty or text cell. Empty if there is no such column.
  std::vector<double> numbers(std::string_view column) const;
  /// The column's texts; numbers as they would be written. Empty if there is no such column.
  std::vector<std::string> texts(std::string_view column) const;
};

std::string csv_text(const CsvTable& table);
/// One row with its line end.
std::string csv_line(const std::vector<CsvCell>& cells);

/// Writes the table atomically. @throws EnvironmentError
void write_csv(const std::filesystem::path& file, const CsvTable& table);
/// A cell that reads as a number is one. @throws EnvironmentError not there; InputError a damaged table
CsvTable read_csv(const std::filesystem::path& file);
/// The same from text; `file` is only for messages.
CsvTable parse_csv(std::string_view text, const std::filesystem::path& file);

}  // namespace sluice
