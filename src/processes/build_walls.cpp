#include <algorithm>
#include <map>

#include "geometry/audit_mesh.h"
#include "geometry/import_mesh.h"
#include "processes/build_parts.h"

namespace sluice {

namespace {

int material_index(const ProcessConfig& config, const std::string& name, const Location& where,
                   std::vector<InputProblem>& problems) {
  for (std::size_t i = 0; i < config.materials.size(); ++i)
    if (config.materials[i].name == name) return static_cast<int>(i);
  std::string known;
  for (const MaterialConfig& m : config.materials) known += (known.empty() ? "" : ", ") + m.name;
  problems.push_back({where, "material", "is '" + name + "', which is not a material",
                      known.empty() ? "'materials' is empty" : "there are: " + known,
                      "name one of them or add it"});
  return 0;
}

/// Faces of the domain that are walls, as two triangles each; they reach a little into their neighbours
/// so that no seam is left at the edges.
void add_domain_walls(const ProcessConfig& config, std::vector<Wall>& walls,
                      std::vector<InputProblem>& problems) {
  const Domain domain = config.domain.domain();
  static const char* names[3] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end) {
      if ((end == 0 ? domain.low : domain.high)[static_cast<std::size_t>(axis)] != Face::wall) continue;
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      std::array<Vec3, 4> corners;
      for (int c = 0; c < 4; ++c) {
        Vec3 x;
        x[axis] = end == 0 ? domain.box.lo[axis] : domain.box.hi[axis];
        x[u] = (c == 0 || c == 3) ? domain.box.lo[u] : domain.box.hi[u];
        x[v] = (c < 2) ? domain.box.lo[v] : domain.box.hi[v];
        corners[static_cast<std::size_t>(c)] = x;
      }
      Wall wall;
      wall.name = std::string("domain_") + names[axis] + (end == 0 ? "_low" : "_high");
      wall.mesh = make_rectangle(wall.name, corners);
      wall.material = material_index(config, config.domain.wall_material, {}, problems);
      walls.push_back(std::move(wall));
    }
}

}  // namespace

std::vector<Wall> build_walls(const ProcessConfig& config) {
  std::vector<Wall> walls;
  std::vector<InputProblem> problems;
  std::map<std::pair<std::string, LengthUnit>, TriMesh> read;  // a file named twice is read once
  for (const WallConfig& entry : config.walls) {
    const int material = material_index(config, entry.material, entry.material_at, problems);
    try {
      const auto key = std::make_pair(entry.file.string(), entry.unit);
      if (!read.count(key)) read[key] = import_mesh(entry.file, metres(entry.unit));
      const TriMesh& mesh = read[key];
      const std::vector<std::string> parts = entry.parts.empty() ? mesh.part_names : entry.parts;
      for (const std::string& part : parts) {
        Wall wall;
        wall.name = parts.size() == 1 ? entry.name : part;
        wall.mesh = extract_part(mesh, part);
        if (entry.repair) repair_mesh(wall.mesh);
        wall.material = material;
        wall.surface_velocity = entry.surface_velocity;
        wall.blocks = entry.blocks;
        if (std::any_of(walls.begin(), walls.end(), [&](const Wall& w) { return w.name == wall.name; }))
          problems.push_back({entry.where, entry.name, "makes a second wall named '" + wall.name + "'",
                              "results name walls", "list the part once, or give the entry another name"});
        walls.push_back(std::move(wall));
      }
    } catch (const InputError& e) {
      for (InputProblem p : e.problems()) {
        // The file says what is wrong with it; the key says where it was named.
        p.problem += p.where.file.empty() ? "" : " at " + p.where.text();
        p.where = entry.file_at;
        if (p.key.empty()) p.key = "file";
        problems.push_back(std::move(p));
      }
    }
  }
  add_domain_walls(config, walls, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return walls;
}

Materials build_materials(const ProcessConfig& config) {
  Materials materials;
  std::vector<InputProblem> problems;
  for (const MaterialConfig& m : config.materials) materials.all.push_back({m.name, m.density});
  materials.pairs.assign(materials.all.size() * materials.all.size(), PairProperties{});
  for (const ContactConfig& contact : config.contacts) {
    if (contact.between.size() != 2) continue;
    const auto a =
        static_cast<std::size_t>(material_index(config, contact.between[0], contact.where, problems));
    const auto b =
        static_cast<std::size_t>(material_index(config, contact.between[1], contact.where, problems));
    if (!problems.empty()) continue;
    materials.pairs[a * materials.all.size() + b] = contact.properties;
    materials.pairs[b * materials.all.size() + a] = contact.properties;
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return materials;
}

}  // namespace sluice
