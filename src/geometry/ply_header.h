#pragma once
/// The header of a PLY file (Turk 1994).

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

enum class PlyFormat { text, binary_little_endian, binary_big_endian };
enum class PlyType { i8, u8, i16, u16, i32, u32, f32, f64 };

std::size_t size_of(PlyType type);  ///< bytes

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::f32;
  bool list = false;
  PlyType count_type = PlyType::u8;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::text;
  std::vector<PlyElement> elements;
  int lines = 0;          ///< of the header
  std::string_view data;  ///< what follows it
};

/// @throws InputError at the line
PlyHeader read_ply_header(const std::filesystem::path& file, std::string_view bytes);

}  // namespace sluice
