#pragma once
/// PLY through CGAL's reader, after our own checks.

#include <filesystem>
#include <string>
#include <vector>

#include "base/vec.h"

namespace sluice {

struct PolygonSoup {
  std::vector<Vec3> vertices;              ///< in the file's unit
  std::vector<std::vector<int>> polygons;  ///< indices of vertices
};

/// @throws InputError
PolygonSoup import_ply(const std::filesystem::path& file, const std::string& bytes);

}  // namespace sluice
