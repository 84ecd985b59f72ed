#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "dem/dem_state.h"
#include "dem/step_limits.h"

namespace sluice {

namespace {
constexpr double overlap_histogram_top = 40, overlap_bin = 0.05;  // percent of the radius

void note(std::vector<InputProblem>& problems, std::string key, std::string problem, const char* reason,
          const char* suggestion) {
  InputProblem& p = problems.emplace_back();
  p.key = std::move(key);
  p.problem = std::move(problem);
  p.reason = reason;
  p.suggestion = suggestion;
}

void check_shapes(const DemScene& scene, std::vector<InputProblem>& problems) {
  if (scene.shapes.empty())
    note(problems, "shapes", "is empty", "every rock has a shape", "give at least a sphere");
  for (const RockShape& shape : scene.shapes) {
    if (!(shape.blockiness >= 2))
      note(problems, "blockiness", fmt::format("is {}", shape.blockiness),
           "below 2 a rock would have edges or be hollow", "use 2 (ellipsoid) to 8 (box)");
    if (!(shape.semi_axes.minCoeff() > 0))
      note(problems, "shape", "has a semi-axis of zero", "a rock has a volume", "use positive axes");
  }
}

void check_materials(const Materials& materials, std::vector<InputProblem>& problems) {
  const std::size_t n = materials.all.size();
  if (materials.pairs.size() != n * n)
    note(problems, "pairs", fmt::format("has {} entries for {} materials", materials.pairs.size(), n),
         "each pair of materials has its own", "give n x n");
  for (const Material& material : materials.all)
    if (!(material.density >= 0))
      note(problems, material.name, fmt::format("has density {}", material.density), "a density is positive",
           "use kg/m3, or 0 for walls");
  for (const PairProperties& pair : materials.pairs) {
    if (!(pair.restitution > 0 && pair.restitution <= 1))
      note(problems, "restitution", fmt::format("is {}", pair.restitution), "it lies in (0, 1]",
           "0.1 to 0.4 is usual for rock");
    if (!(pair.friction >= 0) || !(pair.rolling >= 0))
      note(problems, "friction", "is negative", "friction takes energy", "use 0 or more");
    if (!(pair.adhesion >= 0))
      note(problems, "adhesion", fmt::format("is {} N/m", pair.adhesion), "adhesion pulls", "use 0 or more");
  }
  if (materials.pairs.size() != n * n) return;
  for (std::size_t a = 0; a < n; ++a) {
    const Material& material = materials.all[a];
    const auto first = materials.pairs.begin() + static_cast<std::ptrdiff_t>(a * n);
    if (!std::any_of(first, first + static_cast<std::ptrdiff_t>(n),
                     [](const PairProperties& p) { return p.law == ForceLaw::hertz_mindlin; }))
      continue;
    if (!(material.youngs_modulus > 0))
      note(problems, material.name, fmt::format("has youngs_modulus {}", material.youngs_modulus),
           "a contact of it is hertz_mindlin", "use Pa");
    if (!(material.poissons_ratio > -1 && material.poissons_ratio <= 0.5))
      note(problems, material.name, fmt::format("has poissons_ratio {}", material.poissons_ratio),
           "an elastic solid has one in (-1, 0.5]", "0.2 to 0.3 is usual for rock");
  }
}

void check_sizes(const DemScene& scene, double least_margin, std::vector<InputProblem>& problems) {
  if (!(scene.smallest_size > 0))
    note(problems, "size", fmt::format("of the smallest rock is {} m", scene.smallest_size),
         "it sets stiffness and time step", "use a positive size");
  if (!(scene.largest_size >= scene.smallest_size))
    note(problems, "size", "of the largest rock is below that of the smallest", "", "swap them");
  if (!(scene.densest > 0))
    note(problems, "density", fmt::format("of the densest rock is {} kg/m3", scene.densest),
         "rocks have a mass", "give the rocks' material a density");
  double widest = 0;
  for (const RockShape& shape : scene.shapes) widest = std::max(widest, 2 * shape.bounding_radius);
  widest *= scene.largest_size * (1 + least_margin);
  for (int k = 0; k < 3; ++k)
    if (scene.domain.periodic(k) && scene.domain.box.hi[k] - scene.domain.box.lo[k] < 2 * widest)
      note(problems, "domain", fmt::format("is periodic over less than {:.3g} m", 2 * widest),
           "a rock would meet another one twice", "widen it, or use smaller rocks");
}
}  // namespace

DemSystem::Implementation::Implementation(const DemConfig& config_in, DemScene scene_in,
                                          const Walls& walls_in)
    : config(config_in),
      scene(std::move(scene_in)),
      walls(walls_in),
      still_part(std::any_of(walls.all().begin(), walls.all().end(),
                             [](const Wall& w) { return w.motion.has_value(); })
                     ? std::make_unique<Walls>(still_walls(walls))
                     : nullptr),
      still(still_part ? *still_part : walls),
      surface(still),
      moving(moving_walls(walls)),
      pairs({std::any_of(scene.materials.pairs.begin(), scene.materials.pairs.end(),
                         [](const PairProperties& p) { return p.rolling > 0; }),
             std::any_of(scene.materials.pairs.begin(), scene.materials.pairs.end(),
                         [](const PairProperties& p) { return p.tangential == Tangential::partial_slip; }),
             std::any_of(scene.shapes.begin(), scene.shapes.end(),
                         [](const RockShape& s) { return !s.is_sphere(); })}),
      overlap_histogram(0, overlap_histogram_top,
                        static_cast<std::size_t>(overlap_histogram_top / overlap_bin)) {
  std::vector<InputProblem> problems;
  check_shapes(scene, problems);
  check_materials(scene.materials, problems);
  check_sizes(scene, least_margin, problems);
  if (!problems.empty()) throw InputError(std::move(problems));

  limits = choose_limits(config, scene);
  const int kinds = static_cast<int>(scene.materials.all.size());
  for (int a = 0; a < kinds; ++a)
    for (int b = 0; b < kinds; ++b) {
      laws.push_back(contact_law(scene.materials, a, b, config.end_of_contact));
      has_rolling = has_rolling || laws.back().rolling > 0;
      plain_laws = plain_laws && laws.back().plain();
    }
  const auto is_rock = [](const Material& m) { return m.density > 0; };
  const auto& all = scene.materials.all;
  if (std::count_if(all.begin(), all.end(), is_rock) == 1) {
    const auto rock = static_cast<int>(std::find_if(all.begin(), all.end(), is_rock) - all.begin());
    only_law = &law(rock, rock);
  }
  for (const RockShape& shape : scene.shapes) {
    is_sphere.push_back(shape.is_sphere() ? 1 : 0);
    only_spheres = only_spheres && shape.is_sphere();
    has_blocky = has_blocky || has_faces(shape.blockiness);
  }
  if (has_blocky)
    for (const RockShape& shape : scene.shapes)
      copies.push_back(has_faces(shape.blockiness) ? make_face_copies(shape.semi_axes, shape.blockiness)
                                                   : FaceCopies{});
  has_walls = surface.patch_count() > 0;
  periodic = scene.domain.any_periodic();
}

}  // namespace sluice
