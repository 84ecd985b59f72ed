#include "validation/rock_hertz.h"

#include <fmt/format.h>

#include <algorithm>

#include "validation/measured_table.h"

namespace sluice {

void RockHertz::keys(Schema& s) {
  s.number("steps_per_contact", steps_per_contact, {.at_least = 5, .doc = "time steps in one contact"});
  s.number("radius", radius, {.unit = "m", .above = 0, .doc = "of the spheres"});
  s.number("speed", speed, {.unit = "m/s", .above = 0, .doc = "of each sphere"});
  s.choice("against", against, {{"plane", ImpactAgainst::plane}, {"twin", ImpactAgainst::twin}},
           {.doc = "what the sphere meets: a rigid plane, or its like that comes as fast the other way"});
  s.text("force_time", force_time, {.doc = "published curve of force over time"});
  s.text("force_overlap", force_overlap, {.doc = "published curve of force over overlap"});
}

namespace {

double largest(const std::vector<double>& x) {
  return *std::max_element(x.begin(), x.end());
}

/// Force over time or overlap, from first touch on.
struct Course {
  std::vector<double> x, force;
};

Course over_time(const Impact& impact) {
  Course course{{0}, {0}};
  course.x.insert(course.x.end(), impact.t.begin(), impact.t.end());
  course.force.insert(course.force.end(), impact.force.begin(), impact.force.end());
  if (impact.contact_time > course.x.back()) {
    course.x.push_back(impact.contact_time);
    course.force.push_back(0);
  }
  return course;
}

/// To the largest overlap: so far force over overlap is a function.
Course over_overlap(const Impact& impact) {
  const auto count = std::max_element(impact.overlap.begin(), impact.overlap.end()) - impact.overlap.begin();
  Course course{{0}, {0}};
  course.x.insert(course.x.end(), impact.overlap.begin(), impact.overlap.begin() + count + 1);
  course.force.insert(course.force.end(), impact.force.begin(), impact.force.begin() + count + 1);
  return course;
}

/// Points of the published curve beside the impact's force at the same place, over the largest force.
void add_curve(Measured& out, const std::string& file, const char* place, const Course& course, double peak) {
  if (file.empty()) return;
  const std::optional<CsvTable> curve = measured_table(file);
  if (!curve) {
    out.note = without_table(file);
    return;
  }
  const std::vector<double> at = reference_numbers(*curve, place), force = reference_numbers(*curve, "F_kN");
  for (std::size_t k = 0; k < at.size(); ++k)
    out.values.push_back({fmt::format("force [kN] at {} = {:.4g}", place, at[k]),
                          1e-3 * interpolated(course.x, course.force, 1e-6 * at[k]), force[k], 1e-3 * peak});
}

}  // namespace

Measured RockHertz::run(const CsvTable& reference) const {
  const std::vector<std::string> material = reference_texts(reference, "material");
  const std::vector<double> density = reference_numbers(reference, "density");
  const std::vector<double> modulus = reference_numbers(reference, "youngs_modulus");
  const std::vector<double> poisson = reference_numbers(reference, "poissons_ratio");
  const std::vector<double> overlap = reference_numbers(reference, "overlap");
  const std::vector<double> force = reference_numbers(reference, "force");
  const std::vector<double> time = reference_numbers(reference, "time");
  Measured out;
  for (std::size_t k = 0; k < material.size(); ++k) {
    const ImpactSphere sphere{{material[k], density[k], modulus[k], poisson[k]}, radius};
    const Impact impact = impact_of(sphere, {0, 0, -speed}, against, steps_per_contact);
    out.particle_steps += impact.rock_steps;
    out.values.push_back({"largest overlap [um], " + material[k], 1e6 * largest(impact.overlap),
                          1e6 * overlap[k], 1e6 * overlap[k]});
    out.values.push_back({"largest force [kN], " + material[k], 1e-3 * largest(impact.force), 1e-3 * force[k],
                          1e-3 * force[k]});
    out.values.push_back(
        {"time of contact [us], " + material[k], 1e6 * impact.contact_time, 1e6 * time[k], 1e6 * time[k]});
    out.values.push_back({"speed after over that before, " + material[k], impact.v.z() / speed, 1, 1});
    if (k > 0) continue;
    add_curve(out, force_time, "t_us", over_time(impact), force[k]);
    add_curve(out, force_overlap, "overlap_um", over_overlap(impact), force[k]);
  }
  return out;
}

}  // namespace sluice
