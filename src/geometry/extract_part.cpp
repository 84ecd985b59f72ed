#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "base/errors.h"
#include "geometry/import_mesh.h"

namespace sluice {

namespace {

/// Letters to insert, drop or replace (Levenshtein 1966).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

std::string suggestion_for(const std::string& wanted, const std::vector<std::string>& names) {
  const auto nearest = std::min_element(names.begin(), names.end(), [&](const auto& a, const auto& b) {
    return edit_distance(wanted, a) < edit_distance(wanted, b);
  });
  if (nearest == names.end()) return "name a file that has parts";
  const bool close = 2 * edit_distance(wanted, *nearest) <= std::max(wanted.size(), nearest->size());
  return close ? fmt::format("did you mean '{}'?", *nearest) : "use one of those";
}

}  // namespace

TriMesh extract_part(const TriMesh& mesh, const std::string& part) {
  const auto found = std::find(mesh.part_names.begin(), mesh.part_names.end(), part);
  if (found == mesh.part_names.end()) {
    InputProblem problem;
    problem.key = part;
    problem.problem = "is not a part of the mesh";
    problem.reason = fmt::format("its parts are {}", fmt::join(mesh.part_names, ", "));
    problem.suggestion = suggestion_for(part, mesh.part_names);
    throw InputError(std::move(problem));
  }
  const int index = static_cast<int>(found - mesh.part_names.begin());
  TriMesh own;
  own.part_names = {part};
  std::vector<int> vertex_here(mesh.vertices.size(), -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.part[t] != index) continue;
    std::array<int, 3> corners = mesh.triangles[t];
    for (int& v : corners) {
      int& here = vertex_here[static_cast<std::size_t>(v)];
      if (here < 0) {
        here = static_cast<int>(own.vertices.size());
        own.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
      }
      v = here;
    }
    own.triangles.push_back(corners);
    own.part.push_back(0);
  }
  return own;
}

}  // namespace sluice
