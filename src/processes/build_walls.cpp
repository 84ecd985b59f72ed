#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>

#include "dem/step_limits.h"
#include "geometry/audit_mesh.h"
#include "geometry/import_mesh.h"
#include "processes/build_parts.h"
#include "processes/check_motion.h"
#include "processes/check_places.h"

namespace sluice {

namespace {

/// What names a material: the key and where it stands.
struct Naming {
  const char* key;
  Location where;
};

int material_index(const ProcessConfig& config, const std::string& name, const Naming& naming,
                   std::vector<InputProblem>& problems) {
  for (std::size_t i = 0; i < config.materials.size(); ++i)
    if (config.materials[i].name == name) return static_cast<int>(i);
  std::string known;
  for (const MaterialConfig& m : config.materials) known += (known.empty() ? "" : ", ") + m.name;
  problems.push_back({naming.where, naming.key, "is '" + name + "', which is not a material",
                      known.empty() ? "'materials' is empty" : "there are: " + known,
                      "name one of them or add it"});
  return 0;
}

/// Faces of the domain that are walls, as two triangles each; they reach a little into their neighbours
/// so that no seam is left at the edges.
void add_domain_walls(const ProcessConfig& config, std::vector<Wall>& walls,
                      std::vector<InputProblem>& problems) {
  const Domain domain = config.domain.domain();
  const auto is_wall = [](Face face) { return face == Face::wall; };
  if (std::none_of(domain.low.begin(), domain.low.end(), is_wall) &&
      std::none_of(domain.high.begin(), domain.high.end(), is_wall))
    return;
  const int material = material_index(config, config.domain.wall_material,
                                      {"wall_material", config.domain.wall_material_at}, problems);
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
      wall.material = material;
      walls.push_back(std::move(wall));
    }
}

/// The walls of one entry must be something, and somewhere in the domain.
void check_entry(const WallConfig& entry, const Box& domain, std::span<const Wall> walls,
                 std::vector<InputProblem>& problems) {
  if (walls.empty()) return;  // no part was found; that is said already
  Box bounds;
  double area = 0;
  for (const Wall& wall : walls) {
    bounds.include(wall.mesh.bounds());
    for (std::size_t t = 0; t < wall.mesh.triangles.size(); ++t) area += wall.mesh.area(static_cast<int>(t));
  }
  if (!(area > 0))
    problems.push_back({entry.file_at, "file", fmt::format("names {}: has no area", entry.file.string()),
                        "every facet is a line or a point", "export the part again"});
  else if (!domain.overlaps(bounds))
    problems.push_back({entry.file_at, "file", fmt::format("makes a wall in {}", reach_of(bounds)),
                        fmt::format("the domain reaches {}", reach_of(domain)),
                        "check 'unit', or enlarge the domain"});
}

/// Elastic constants stand where a contact is made from them, and nowhere else.
void check_elasticity(const ProcessConfig& config, std::vector<InputProblem>& problems) {
  for (const MaterialConfig& m : config.materials) {
    const auto named = std::find_if(config.contacts.begin(), config.contacts.end(), [&](const auto& c) {
      return c.properties.law == ForceLaw::hertz_mindlin &&
             std::find(c.between.begin(), c.between.end(), m.name) != c.between.end();
    });
    const bool needed = named != config.contacts.end();
    const auto check = [&](const char* key, bool given, const Location& at, const char* example) {
      if (needed && !given)
        problems.push_back({m.where, key, fmt::format("is missing for '{}'", m.name),
                            fmt::format("line {} makes {} on {} hertz_mindlin", named->law_at.line,
                                        named->between[0], named->between[1]),
                            fmt::format("add it, for example {}", example)});
      if (!needed && given)
        problems.push_back({at, key, fmt::format("has no effect on '{}'", m.name),
                            "no contact of it has 'law: hertz_mindlin'", "set the law, or take it out"});
    };
    check("youngs_modulus", m.youngs_modulus.has_value(), m.youngs_modulus_at, "'youngs_modulus: 50 MPa'");
    check("poissons_ratio", m.poissons_ratio.has_value(), m.poissons_ratio_at, "'poissons_ratio: 0.25'");
  }
}

/// What sets the stiffness of the linear law is of no use where no rock has it.
void check_linear_keys(const ProcessConfig& config, const Materials& materials,
                       std::vector<InputProblem>& problems) {
  if (!config.rocks || linear_law_used(materials)) return;
  for (const auto& [key, at] : config.rocks->linear_keys)
    problems.push_back({at, key, "has no effect", "every contact of the rocks has 'law: hertz_mindlin'",
                        "take it out; the stiffness is that of 'youngs_modulus'"});
}

}  // namespace

std::vector<Wall> build_walls(const ProcessConfig& config) {
  std::vector<Wall> walls;
  std::vector<InputProblem> problems;
  std::map<std::pair<std::string, LengthUnit>, TriMesh> read;  // a file named twice is read once
  for (const WallConfig& entry : config.walls) {
    const int material = material_index(config, entry.material, {"material", entry.material_at}, problems);
    try {
      const auto key = std::make_pair(entry.file.string(), entry.unit);
      if (!read.count(key)) read[key] = import_mesh(entry.file, metres(entry.unit));
      const TriMesh& mesh = read[key];
      const std::size_t first = walls.size();
      const std::vector<std::string> parts = entry.parts.empty() ? mesh.part_names : entry.parts;
      for (const std::string& part : parts) {
        if (std::find(mesh.part_names.begin(), mesh.part_names.end(), part) == mesh.part_names.end()) {
          try {
            extract_part(mesh, part);
          } catch (const InputError& e) {  // it knows the names and which one was meant
            const InputProblem& p = e.problems().front();
            problems.push_back(
                {entry.parts_at, "parts",
                 fmt::format("names '{}', which is no part of '{}'", part, entry.file.filename().string()),
                 p.reason, p.suggestion});
          }
          continue;
        }
        Wall wall;
        wall.name = parts.size() == 1 ? entry.name : part;
        wall.mesh = extract_part(mesh, part);
        if (entry.repair) repair_mesh(wall.mesh);
        wall.material = material;
        wall.surface_velocity = entry.surface_velocity;
        wall.blocks = entry.blocks;
        wall.motion = entry.motion;
        if (std::any_of(walls.begin(), walls.end(), [&](const Wall& w) { return w.name == wall.name; }))
          problems.push_back({entry.where, entry.name, "makes a second wall named '" + wall.name + "'",
                              "results name walls", "list the part once, or give the entry another name"});
        walls.push_back(std::move(wall));
      }
      const std::span<const Wall> made = std::span<const Wall>(walls).subspan(first);
      check_entry(entry, config.domain.domain().box, made, problems);
      std::ranges::move(motion_problems(config, entry, made), std::back_inserter(problems));
    } catch (const InputError& e) {
      for (InputProblem p : e.problems()) {
        // The file says what is wrong with it; the key says where it was named.
        if (!p.where.file.empty()) p.problem = fmt::format("names {}: {}", p.where.text(), p.problem);
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
  for (const MaterialConfig& m : config.materials)
    materials.all.push_back({m.name, m.density, m.youngs_modulus.value_or(0), m.poissons_ratio.value_or(0)});
  PairProperties unstated;
  unstated.meets = false;
  materials.pairs.assign(materials.all.size() * materials.all.size(), unstated);
  std::map<std::pair<std::size_t, std::size_t>, Location> stated;
  for (const ContactConfig& contact : config.contacts) {
    const std::size_t known = problems.size();
    const Naming naming{"between", contact.where};
    const auto a = static_cast<std::size_t>(material_index(config, contact.between.at(0), naming, problems));
    const auto b = static_cast<std::size_t>(material_index(config, contact.between.at(1), naming, problems));
    if (problems.size() > known) continue;
    const auto [first, fresh] = stated.emplace(std::minmax(a, b), contact.where);
    if (!fresh)
      problems.push_back({contact.where, "between",
                          fmt::format("names {} and {} again", contact.between[0], contact.between[1]),
                          fmt::format("the pair stands in line {} already", first->second.line), "keep one"});
    materials.pairs[a * materials.all.size() + b] = contact.properties;
    materials.pairs[b * materials.all.size() + a] = contact.properties;
  }
  check_elasticity(config, problems);
  check_linear_keys(config, materials, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return materials;
}

}  // namespace sluice
