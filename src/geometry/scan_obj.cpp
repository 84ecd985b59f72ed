#include "geometry/scan_obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/read_text.h"

namespace sluice {

namespace {

constexpr std::array free_form{"curv", "curv2", "surf", "cstype", "bzp", "bsp", "cdc", "cdp"};

struct Scanner {
  const std::filesystem::path& file;
  std::string_view part_keyword;
  ObjScan scan;
  int part = -1;

  void enter_part(std::string name) {
    if (name.empty()) name = file.stem().string();
    const auto found = std::find(scan.part_names.begin(), scan.part_names.end(), name);
    part = static_cast<int>(found - scan.part_names.begin());
    if (found == scan.part_names.end()) scan.part_names.push_back(std::move(name));
  }

  void vertex(const std::vector<std::string_view>& words, int line) {
    if (words.size() < 4)
      throw file_error(file, line, fmt::format("a vertex has {} coordinates", words.size() - 1),
                       "three are needed", "export the part again");
    Vec3 x;
    for (int k = 0; k < 3; ++k) {
      const auto word = words[static_cast<std::size_t>(k + 1)];
      const auto value = number_of(word);
      if (!value || !std::isfinite(*value))
        throw file_error(file, line,
                         fmt::format("vertex {} has coordinate '{}'", scan.vertices.size() + 1, word),
                         "a finite number is needed", "repair the part in the CAD program");
      x[k] = *value;
    }
    scan.vertices.push_back(x);
  }

  void face(const std::vector<std::string_view>& words, int line) {
    if (words.size() < 4)
      throw file_error(file, line, fmt::format("a facet has {} corners", words.size() - 1),
                       "at least three are needed", "export the part again");
    if (part < 0) enter_part("");
    ObjScan::Face face{part, {}, line};
    for (std::size_t k = 1; k < words.size(); ++k) {
      const auto index = integer_of(words[k].substr(0, words[k].find('/')));
      const auto count = static_cast<long long>(scan.vertices.size());
      const long long corner = !index ? -1 : *index < 0 ? count + *index : *index - 1;
      if (corner < 0 || corner >= count)
        throw file_error(file, line, fmt::format("a facet names vertex '{}'", words[k]),
                         fmt::format("there are {} vertices so far", count), "export the part again");
      face.corners.push_back(static_cast<int>(corner));
    }
    scan.faces.push_back(std::move(face));
  }

  void line(std::string_view text, int number) {
    const std::vector<std::string_view> words = words_of(text.substr(0, text.find('#')));
    if (words.empty()) return;
    if (words[0] == "v") {
      vertex(words, number);
    } else if (words[0] == "f" || words[0] == "fo") {
      face(words, number);
    } else if (words[0] == part_keyword) {
      enter_part(std::string(trimmed(trimmed(text).substr(1))));
    } else if (std::find(free_form.begin(), free_form.end(), words[0]) != free_form.end()) {
      throw file_error(file, number, fmt::format("'{}' is a free-form surface", words[0]),
                       "facets are needed", "export the part as triangles");
    }
  }
};

bool has_objects(std::string_view text) {
  Lines lines(text);
  for (std::string_view line; lines.next(line);)
    if (line = trimmed(line); line.starts_with("o ") || line.starts_with("o\t")) return true;
  return false;
}

}  // namespace

ObjScan scan_obj(const std::filesystem::path& file, std::string_view text) {
  Scanner scanner{file, has_objects(text) ? "o" : "g", {}, -1};
  Lines lines(text);
  std::string joined;  // a line that ends with a backslash goes on
  for (std::string_view line; lines.next(line);) {
    if (line.ends_with('\\')) {
      joined += line.substr(0, line.size() - 1);
      joined += ' ';
      continue;
    }
    joined += line;
    scanner.line(joined, lines.number());
    joined.clear();
  }
  if (!joined.empty()) scanner.line(joined, lines.number());
  return std::move(scanner.scan);
}

}  // namespace sluice
