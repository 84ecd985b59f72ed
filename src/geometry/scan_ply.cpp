#include "geometry/scan_ply.h"

#include <fmt/format.h>

#include <bit>
#include <cctype>
#include <cmath>

#include "geometry/ply_header.h"
#include "geometry/read_text.h"

namespace sluice {

namespace {

/// Numbers of the data section, one after the other.
class Numbers {
 public:
  Numbers(const std::filesystem::path& file, const PlyHeader& header)
      : file_(file), format_(header.format), rest_(header.data), line_(header.lines + 1) {}

  double next(PlyType type, std::string_view what) {
    return format_ == PlyFormat::text ? next_word(type, what) : next_bytes(type, what);
  }
  [[noreturn]] void fail(std::string problem, std::string reason) const {
    throw file_error(file_, format_ == PlyFormat::text ? line_ : 0, std::move(problem), std::move(reason),
                     "export or copy the part again");
  }
  /// At least this many bytes are left, or the header promises too much.
  void expect_bytes(std::uint64_t items, std::uint64_t bytes_each, const std::string& element) const {
    if (bytes_each == 0 || items <= rest_.size() / bytes_each) return;
    throw file_error(file_, 0, fmt::format("states {} of element '{}'", items, element),
                     fmt::format("{} bytes of data are left, too few for that", rest_.size()),
                     "export or copy the part again");
  }

 private:
  [[noreturn]] void throw_end(std::string_view what) const {
    fail("ends too early", fmt::format("{} is missing", what));
  }

  double next_word(PlyType type, std::string_view what) {
    std::size_t start = 0;
    while (start < rest_.size() && std::isspace(static_cast<unsigned char>(rest_[start])) != 0) {
      line_ += rest_[start] == '\n';
      ++start;
    }
    rest_.remove_prefix(start);
    std::size_t end = 0;
    while (end < rest_.size() && std::isspace(static_cast<unsigned char>(rest_[end])) == 0) ++end;
    if (end == 0) throw_end(what);
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(end);
    const bool whole = type != PlyType::f32 && type != PlyType::f64;
    const auto value = number_of(word);
    if (!value || (whole && !integer_of(word)))
      fail(fmt::format("has '{}' for {}", word, what),
           whole ? "a whole number is needed" : "a number is needed");
    return *value;
  }

  double next_bytes(PlyType type, std::string_view what) {
    const std::size_t size = size_of(type);
    if (rest_.size() < size) throw_end(what);
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t from = format_ == PlyFormat::binary_big_endian ? size - 1 - k : k;
      bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(rest_[from])) << (8 * k);
    }
    rest_.remove_prefix(size);
    switch (type) {
      case PlyType::i8:
        return static_cast<std::int8_t>(bits);
      case PlyType::i16:
        return static_cast<std::int16_t>(bits);
      case PlyType::i32:
        return static_cast<std::int32_t>(bits);
      case PlyType::f32:
        return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
      case PlyType::f64:
        return std::bit_cast<double>(bits);
      default:
        return static_cast<double>(bits);
    }
  }

  const std::filesystem::path& file_;
  PlyFormat format_;
  std::string_view rest_;
  int line_;
};

bool is_coordinate(const PlyElement& element, const PlyProperty& property) {
  return element.name == "vertex" && (property.name == "x" || property.name == "y" || property.name == "z");
}

bool is_corner_list(const PlyElement& element, const PlyProperty& property) {
  return element.name == "face" && property.list &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// One number of an element that has no list, or one list.
void scan_property(const PlyElement& element, const PlyProperty& property, std::uint64_t vertices,
                   Numbers& numbers) {
  if (!property.list) {
    const double value = numbers.next(property.type, property.name);
    if (is_coordinate(element, property) && !std::isfinite(value))
      numbers.fail(fmt::format("a vertex has coordinate '{}'", value), "a finite number is needed");
    return;
  }
  const double length = numbers.next(property.count_type, "the length of " + property.name);
  if (length < 0) numbers.fail(fmt::format("a list has length {}", length), "it cannot be negative");
  const bool corners = is_corner_list(element, property);
  if (corners && length < 3)
    numbers.fail(fmt::format("a facet has {} corners", length), "at least three are needed");
  for (double k = 0; k < length; ++k) {
    const double value = numbers.next(property.type, property.name);
    if (corners && !(value >= 0 && value < static_cast<double>(vertices)))
      numbers.fail(fmt::format("a facet names vertex {}", value),
                   fmt::format("there are {} vertices", vertices));
  }
}

/// What the reader behind this needs to find.
PlyScan expect_mesh(const std::filesystem::path& file, const PlyHeader& header) {
  PlyScan scan;
  int coordinates = 0, corner_lists = 0;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") scan.vertices = element.count;
    if (element.name == "face") scan.faces = element.count;
    for (const PlyProperty& property : element.properties) {
      if (is_coordinate(element, property)) coordinates += !property.list && size_of(property.type) >= 4;
      if (is_corner_list(element, property))
        corner_lists += property.type == PlyType::i32 || property.type == PlyType::u32;
    }
  }
  if (coordinates != 3)
    throw file_error(file, 0, "has no x, y, z of 'vertex' as float or double", "a surface is needed",
                     "export the part as a mesh");
  if (corner_lists != 1)
    throw file_error(file, 0, "has no list 'vertex_indices' of 'face' as int or uint", "a surface is needed",
                     "export the part as a mesh with 32-bit indices");
  return scan;
}

}  // namespace

PlyScan scan_ply(const std::filesystem::path& file, std::string_view bytes) {
  const PlyHeader header = read_ply_header(file, bytes);
  const PlyScan scan = expect_mesh(file, header);
  Numbers numbers(file, header);
  for (const PlyElement& element : header.elements) {
    // Every number takes a byte at least (two in text, less the last): a false count ends here, not in a
    // loop.
    std::uint64_t least = 0;
    for (const PlyProperty& p : element.properties) {
      const PlyType first = p.list ? p.count_type : p.type;
      least += header.format == PlyFormat::text ? 1 : size_of(first);
    }
    numbers.expect_bytes(element.count, least, element.name);
    if (element.properties.empty() && element.count > 0)
      numbers.fail(fmt::format("element '{}' has no properties", element.name), "its data cannot be found");
    for (std::uint64_t k = 0; k < element.count; ++k)
      for (const PlyProperty& property : element.properties)
        scan_property(element, property, scan.vertices, numbers);
  }
  return scan;
}

}  // namespace sluice
