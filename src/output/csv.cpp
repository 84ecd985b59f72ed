#include "output/csv.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "base/errors.h"
#include "output/run_folder.h"

namespace sluice {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

std::string cell_text(const CsvCell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return quoted(*text);
  const double number = std::get<double>(cell);
  return std::isfinite(number) ? fmt::format("{}", number) : "";
}

CsvCell cell_of(std::string text, bool was_quoted) {
  if (was_quoted) return text;
  if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size()) return number;
  return text;
}

/// Splits RFC 4180 text into rows of cells.
class Splitter {
 public:
  explicit Splitter(std::string_view text) : text_(text) {}
  bool at_end() const { return at_ >= text_.size(); }
  /// False if a quotation is not closed or something follows it in its cell.
  bool read_row(std::vector<CsvCell>& row) {
    row.clear();
    for (;;) {
      if (!read_cell(row)) return false;
      if (at_end()) return true;
      const char c = text_[at_++];
      if (c == ',') continue;
      if (c == '\r' && !at_end() && text_[at_] == '\n') ++at_;
      return c == '\n' || c == '\r';
    }
  }

 private:
  bool read_cell(std::vector<CsvCell>& row) {
    std::string cell;
    if (at_end() || text_[at_] != '"') {
      while (!at_end() && text_[at_] != ',' && text_[at_] != '\n' && text_[at_] != '\r') cell += text_[at_++];
      row.push_back(cell_of(std::move(cell), false));
      return true;
    }
    for (++at_; !at_end(); ++at_) {
      if (text_[at_] != '"') {
        cell += text_[at_];
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
        cell += '"';
        ++at_;
      } else {
        ++at_;
        row.push_back(cell_of(std::move(cell), true));
        return true;
      }
    }
    return false;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

[[noreturn]] void damaged(const std::filesystem::path& file, int row, const std::string& problem) {
  refuse_file(file, {"is a damaged table", problem, "run the case again", row});
}

}  // namespace

void CsvTable::add(std::vector<CsvCell> row) {
  rows.push_back(std::move(row));
}

std::optional<std::size_t> CsvTable::find(std::string_view column) const {
  for (std::size_t k = 0; k < columns.size(); ++k)
    if (columns[k] == column) return k;
  return std::nullopt;
}

std::vector<double> CsvTable::numbers(std::string_view column) const {
  std::vector<double> out;
  const auto k = find(column);
  if (!k) return out;
  for (const auto& row : rows) {
    const double* number = std::get_if<double>(&row[*k]);
    out.push_back(number ? *number : std::numeric_limits<double>::quiet_NaN());
  }
  return out;
}

std::vector<std::string> CsvTable::texts(std::string_view column) const {
  std::vector<std::string> out;
  const auto k = find(column);
  if (!k) return out;
  for (const auto& row : rows) {
    const auto* text = std::get_if<std::string>(&row[*k]);
    out.push_back(text ? *text : cell_text(row[*k]));
  }
  return out;
}

std::string csv_line(const std::vector<CsvCell>& cells) {
  std::string line;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k > 0) line += ',';
    line += cell_text(cells[k]);
  }
  return line + '\n';
}

std::string csv_text(const CsvTable& table) {
  std::string text = csv_line({table.columns.begin(), table.columns.end()});
  for (const auto& row : table.rows) text += csv_line(row);
  return text;
}

void write_csv(const std::filesystem::path& file, const CsvTable& table) {
  write_atomically(file, csv_text(table));
}

CsvTable read_csv(const std::filesystem::path& file) {
  return parse_csv(read_whole_file(file), file);
}

CsvTable parse_csv(std::string_view text, const std::filesystem::path& file) {
  Splitter splitter(text);
  CsvTable table;
  std::vector<CsvCell> row;
  if (splitter.at_end()) damaged(file, 1, "it is empty");
  if (!splitter.read_row(row)) damaged(file, 1, "a quotation is not closed");
  for (const CsvCell& cell : row) {
    const auto* name = std::get_if<std::string>(&cell);
    if (!name) damaged(file, 1, "a column has no name");
    table.columns.push_back(*name);
  }
  for (int line = 2; !splitter.at_end(); ++line) {
    if (!splitter.read_row(row)) damaged(file, line, "a quotation is not closed");
    if (row.size() != table.columns.size())
      damaged(file, line, fmt::format("{} cells in a row, {} columns", row.size(), table.columns.size()));
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace sluice
