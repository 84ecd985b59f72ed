#pragma once
/// Our own look at an STL file, of either kind.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

struct StlScan {
  struct Solid {
    std::string name;       ///< may hold blanks; empty if the file gives none
    std::string_view text;  ///< from `solid` to `endsolid`, or the whole binary file
    std::size_t facets = 0;
  };
  std::vector<Solid> solids;  ///< those that have facets
};

/// Checks a binary file's facet count against its size, and every line of a text file.
/// @throws InputError: truncated, endsolid missing, a facet without three vertices, a coordinate that is
///         not a finite number
StlScan scan_stl(const std::filesystem::path& file, std::string_view bytes);

}  // namespace sluice
