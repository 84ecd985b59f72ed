#include "geometry/import_ply.h"

#include <CGAL/IO/PLY.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <array>
#include <sstream>

#include "geometry/read_text.h"
#include "geometry/scan_ply.h"

namespace sluice {

PolygonSoup import_ply(const std::filesystem::path& file, const std::string& bytes) {
  const PlyScan stated = scan_ply(file, bytes);
  std::istringstream in(bytes, std::ios::binary);
  std::vector<CGAL::Simple_cartesian<double>::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  const bool read = CGAL::IO::read_PLY(in, points, polygons);
  if (!read || points.size() != stated.vertices || polygons.size() != stated.faces)
    throw file_error(file, 0, fmt::format("gave {} vertices and {} facets", points.size(), polygons.size()),
                     fmt::format("it states {} and {}", stated.vertices, stated.faces),
                     "export the part again, or as OBJ");
  PolygonSoup soup;
  for (const auto& p : points) soup.vertices.emplace_back(p.x(), p.y(), p.z());
  for (const auto& polygon : polygons) soup.polygons.emplace_back(polygon.begin(), polygon.end());
  return soup;
}

}  // namespace sluice
