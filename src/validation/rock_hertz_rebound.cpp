#include "validation/rock_hertz_rebound.h"

#include <fmt/format.h>

#include "validation/rock_impact.h"

namespace sluice {

void RockHertzRebound::keys(Schema& s) {
  s.number("steps_per_contact", steps_per_contact, {.at_least = 5, .doc = "time steps in one contact"});
  s.number("radius", radius, {.unit = "m", .above = 0, .doc = "of the sphere"});
  s.number("speed", speed, {.unit = "m/s", .above = 0, .doc = "of the sphere"});
}

Measured RockHertzRebound::run(const CsvTable& reference) const {
  const std::vector<std::string> material = reference_texts(reference, "material");
  const std::vector<double> density = reference_numbers(reference, "density");
  const std::vector<double> modulus = reference_numbers(reference, "youngs_modulus");
  const std::vector<double> poisson = reference_numbers(reference, "poissons_ratio");
  const std::vector<double> asked = reference_numbers(reference, "restitution");
  Measured out;
  for (std::size_t k = 0; k < material.size(); ++k) {
    const ImpactSphere sphere{{material[k], density[k], modulus[k], poisson[k]}, radius, 0, asked[k]};
    const Impact impact = impact_of(sphere, {0, 0, -speed}, ImpactAgainst::plane, steps_per_contact);
    out.particle_steps += impact.rock_steps;
    out.values.push_back(
        {fmt::format("restitution, {} asked, {}", asked[k], material[k]), impact.v.z() / speed, asked[k], 1});
  }
  return out;
}

}  // namespace sluice
