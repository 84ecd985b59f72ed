#pragma once
/// Our own look at a PLY file: header, counts against the data that is there, every number and index.
/// A library sees the file only after that.

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace sluice {

struct PlyScan {
  std::size_t vertices = 0;
  std::size_t faces = 0;
};

/// @throws InputError: no PLY header, damaged header, fewer data than the header states, a coordinate that is
///         not a finite number, an index out of range, a list type that the reader does not know
PlyScan scan_ply(const std::filesystem::path& file, std::string_view bytes);

}  // namespace sluice
