#include "geometry/ply_header.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <utility>

#include "geometry/read_text.h"

namespace sluice {

namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> type_names{{{"char", PlyType::i8},
                                                                           {"int8", PlyType::i8},
                                                                           {"uchar", PlyType::u8},
                                                                           {"uint8", PlyType::u8},
                                                                           {"short", PlyType::i16},
                                                                           {"int16", PlyType::i16},
                                                                           {"ushort", PlyType::u16},
                                                                           {"uint16", PlyType::u16},
                                                                           {"int", PlyType::i32},
                                                                           {"int32", PlyType::i32},
                                                                           {"uint", PlyType::u32},
                                                                           {"uint32", PlyType::u32},
                                                                           {"float", PlyType::f32},
                                                                           {"float32", PlyType::f32},
                                                                           {"double", PlyType::f64},
                                                                           {"float64", PlyType::f64}}};

std::optional<PlyType> type_named(std::string_view name) {
  for (const auto& [word, type] : type_names)
    if (word == name) return type;
  return std::nullopt;
}

std::optional<PlyFormat> format_named(std::string_view name) {
  if (name == "ascii") return PlyFormat::text;
  if (name == "binary_little_endian") return PlyFormat::binary_little_endian;
  if (name == "binary_big_endian") return PlyFormat::binary_big_endian;
  return std::nullopt;
}

using Words = std::vector<std::string_view>;

std::optional<PlyProperty> property_of(const Words& words) {
  if (words.size() == 3) {
    const auto type = type_named(words[1]);
    if (type) return PlyProperty{std::string(words[2]), *type, false, PlyType::u8};
  } else if (words.size() == 5 && words[1] == "list") {
    const auto count = type_named(words[2]), type = type_named(words[3]);
    if (count && type && *count != PlyType::f32 && *count != PlyType::f64)
      return PlyProperty{std::string(words[4]), *type, true, *count};
  }
  return std::nullopt;
}

/// Takes one line into the header; false if the line is none of PLY's.
bool take_line(const Words& words, PlyHeader& header) {
  if (words[0] == "comment" || words[0] == "obj_info") return true;
  if (words[0] == "element" && words.size() == 3) {
    const auto count = integer_of(words[2]);
    if (!count || *count < 0) return false;
    header.elements.push_back({std::string(words[1]), static_cast<std::uint64_t>(*count), {}});
    return true;
  }
  if (words[0] == "property" && !header.elements.empty()) {
    auto property = property_of(words);
    if (property) header.elements.back().properties.push_back(std::move(*property));
    return property.has_value();
  }
  return false;
}

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::i8:
    case PlyType::u8:
      return 1;
    case PlyType::i16:
    case PlyType::u16:
      return 2;
    case PlyType::i32:
    case PlyType::u32:
    case PlyType::f32:
      return 4;
    case PlyType::f64:
      break;
  }
  return 8;
}

PlyHeader read_ply_header(const std::filesystem::path& file, std::string_view bytes) {
  const std::string again = "export the part again";
  Lines lines(bytes);
  std::string_view line;
  if (!lines.next(line) || trimmed(line) != "ply")
    throw file_error(file, 1, "does not start with 'ply'", "a PLY file does", again);
  PlyHeader header;
  bool has_format = false;
  while (lines.next(line)) {
    const Words words = words_of(line);
    if (words.empty()) continue;
    if (words[0] == "end_header") {
      if (!has_format) throw file_error(file, lines.number(), "has no 'format' line", "PLY needs one", again);
      header.lines = lines.number();
      header.data = lines.rest();
      return header;
    }
    const auto format = words[0] == "format" && words.size() == 3 ? format_named(words[1]) : std::nullopt;
    if (format) {
      header.format = *format;
      has_format = true;
    } else if (!take_line(words, header)) {
      throw file_error(file, lines.number(), fmt::format("reads '{}'", line.substr(0, 60)),
                       "this is no line of a PLY header", again);
    }
  }
  throw file_error(file, lines.number(), "has no 'end_header'", "the header is cut off", again);
}

}  // namespace sluice
