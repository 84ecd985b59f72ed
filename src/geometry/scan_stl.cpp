#include "geometry/scan_stl.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "geometry/read_text.h"

namespace sluice {

namespace {

constexpr std::size_t header_bytes = 84, facet_bytes = 50;

std::uint64_t stated_facets(std::string_view bytes) {
  std::uint64_t count = 0;
  for (std::size_t k = 0; k < 4; ++k)
    count |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[80 + k])) << (8 * k);
  return count;
}

bool is_text(std::string_view bytes) {
  const std::string_view start = bytes.substr(0, 2048);
  return trimmed(start.substr(0, start.find('\n'))).starts_with("solid") && start.find('\0') == start.npos;
}

StlScan scan_binary(const std::filesystem::path& file, std::string_view bytes) {
  if (bytes.size() < header_bytes)
    throw file_error(file, 0, fmt::format("has {} bytes", bytes.size()),
                     "a binary STL starts with 84, a text STL with 'solid'", "export the part again");
  const std::uint64_t facets = stated_facets(bytes);
  const std::uint64_t needed = header_bytes + facet_bytes * facets;
  if (bytes.size() != needed)
    throw file_error(file, 0, fmt::format("has {} bytes", bytes.size()),
                     fmt::format("its {} facets take {}{}", facets, needed,
                                 bytes.size() < needed ? "; it is truncated" : ""),
                     "export or copy the part again");
  if (facets == 0) return {};
  return {{{"", bytes, static_cast<std::size_t>(facets)}}};
}

/// Follows the grammar of a text STL line by line.
class TextScanner {
 public:
  TextScanner(const std::filesystem::path& file, std::string_view bytes) : file_(file), lines_(bytes) {}

  StlScan scan() {
    StlScan found;
    std::string_view line;
    while (next(line)) {
      if (!line.starts_with("solid")) fail(line, "'solid' is expected");
      StlScan::Solid solid;
      solid.name = std::string(trimmed(line.substr(5)));
      const char* start = line.data();
      while (true) {
        if (!next(line)) throw_open_end(solid);
        if (line.starts_with("endsolid")) break;
        facet(line);
        ++solid.facets;
      }
      solid.text = {start, static_cast<std::size_t>(line.data() + line.size() - start)};
      if (solid.facets > 0) found.solids.push_back(std::move(solid));
    }
    return found;
  }

 private:
  /// Next line that is not blank.
  bool next(std::string_view& line) {
    while (lines_.next(line)) {
      line = trimmed(line);
      if (!line.empty()) return true;
    }
    return false;
  }
  [[noreturn]] void fail(std::string_view line, const std::string& reason) {
    throw file_error(file_, lines_.number(), fmt::format("reads '{}'", line.substr(0, 60)), reason,
                     "export the part again");
  }
  [[noreturn]] void throw_open_end(const StlScan::Solid& solid) {
    throw file_error(file_, lines_.number(), fmt::format("ends inside solid '{}'", solid.name),
                     "no 'endsolid': the file is truncated", "export or copy the part again");
  }
  void expect_line(std::string_view wanted) {
    std::string_view line;
    if (!next(line))
      throw file_error(file_, lines_.number(), "ends inside a facet",
                       fmt::format("'{}' is missing: the file is truncated", wanted),
                       "export or copy the part again");
    if (!line.starts_with(wanted)) fail(line, fmt::format("'{}' is expected", wanted));
    if (wanted == "vertex") vertex(line);
  }
  void vertex(std::string_view line) {
    const auto words = words_of(line);
    if (words.size() != 4) fail(line, "a vertex has three coordinates");
    for (std::size_t k = 1; k < 4; ++k) {
      const auto value = number_of(words[k]);
      if (!value || !std::isfinite(*value)) fail(line, fmt::format("'{}' is not a finite number", words[k]));
    }
  }
  void facet(std::string_view line) {
    if (!line.starts_with("facet")) fail(line, "'facet' or 'endsolid' is expected");
    expect_line("outer");
    for (int k = 0; k < 3; ++k) expect_line("vertex");
    expect_line("endloop");
    expect_line("endfacet");
  }

  const std::filesystem::path& file_;
  Lines lines_;
};

}  // namespace

StlScan scan_stl(const std::filesystem::path& file, std::string_view bytes) {
  const bool size_fits =
      bytes.size() >= header_bytes && bytes.size() == header_bytes + facet_bytes * stated_facets(bytes);
  if (!size_fits && is_text(bytes)) return TextScanner(file, bytes).scan();
  return scan_binary(file, bytes);
}

}  // namespace sluice
