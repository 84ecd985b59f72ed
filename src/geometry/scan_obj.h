#pragma once
/// Our own look at an OBJ file: names with blanks, coordinates in double, and every index checked.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"

namespace sluice {

struct ObjScan {
  struct Face {
    int part = 0;              ///< index of part_names
    std::vector<int> corners;  ///< indices of vertices, at least three
    int line = 0;
  };
  std::vector<Vec3> vertices;  ///< in the file's unit
  std::vector<std::string> part_names;
  std::vector<Face> faces;
};

/// Parts are the `o` of the file, or its `g` where it has no `o`, or else one part named after the file.
/// Points and lines have no surface and are left out; free-form surfaces are an error.
/// @throws InputError at the line
ObjScan scan_obj(const std::filesystem::path& file, std::string_view text);

}  // namespace sluice
