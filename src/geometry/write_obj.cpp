#include <fmt/format.h>

#include <fstream>
#include <map>
#include <sstream>

#include "base/errors.h"
#include "geometry/import_mesh.h"

namespace sluice {

void write_obj(const std::filesystem::path& file, const TriMesh& mesh, double unit_in_metres,
               const std::string& comment) {
  std::string text;
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);) text += fmt::format("# {}\n", line);
  int written = 0;  // vertices so far; OBJ counts from 1
  for (std::size_t part = 0; part < mesh.part_names.size(); ++part) {
    text += fmt::format("o {}\n", mesh.part_names[part]);
    std::map<int, int> number;
    std::string faces;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (mesh.part[t] != static_cast<int>(part)) continue;
      faces += 'f';
      for (int v : mesh.triangles[t]) {
        const auto [entry, is_new] = number.try_emplace(v, written + 1);
        if (is_new) {
          ++written;
          const Vec3 x = mesh.vertices[static_cast<std::size_t>(v)] / unit_in_metres + Vec3::Zero();
          text += fmt::format("v {:.10g} {:.10g} {:.10g}\n", x.x(), x.y(), x.z());
        }
        faces += fmt::format(" {}", entry->second);
      }
      faces += '\n';
    }
    text += faces;
  }
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw EnvironmentError(fmt::format("cannot write {}", file.string()));
}

}  // namespace sluice
