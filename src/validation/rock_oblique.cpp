#include "validation/rock_oblique.h"

#include <fmt/format.h>

#include <numbers>

#include "validation/rock_scenes.h"

namespace sluice {

void RockOblique::keys(Schema& s) {
  s.number("steps_per_contact", steps_per_contact, {.at_least = 3, .doc = "time steps in one contact"});
  s.number("friction", friction, {.above = 0, .doc = "Coulomb's coefficient"});
}

Measured RockOblique::run(const CsvTable& reference) const {
  const std::vector<double> kappa = reference_numbers(reference, "kappa");
  const std::vector<double> before = reference_numbers(reference, "psi1");
  const std::vector<double> after = reference_numbers(reference, "psi2");
  constexpr double speed = 1;  // along the normal [m/s]
  Measured out;
  for (std::size_t k = 0; k < kappa.size(); ++k) {
    RockSetup setup;
    setup.pair = {1, friction, 0};
    setup.tangential_ratio = kappa[k];
    setup.stiffness_per_size = 1e12;  // the lever arm stays the radius: the reference knows no overlap
    RockScene scene(setup, {level_wall(setup, 0)});
    const double radius = 0.5 * setup.largest;
    const double k_n = setup.stiffness_per_size * setup.largest;
    const double contact = std::numbers::pi * std::sqrt(scene.dem->mass_of(0, 0, setup.largest) / k_n);
    const double dt = contact / steps_per_contact;
    scene.dem->add({.x = {0, 0, radius + 0.5 * speed * dt},
                    .v = {before[k] * friction * speed, 0, -speed},
                    .size = setup.largest});
    for (int n = 0; n < 1.5 * steps_per_contact; ++n) scene.step(dt);
    const double surface = scene.rocks().v[0].x() - radius * scene.rocks().w[0].y();
    out.values.push_back({fmt::format("psi2 at k_t/k_n = {:.4g}, psi1 = {:g}", kappa[k], before[k]),
                          surface / (friction * speed), after[k], 1});
    out.particle_steps += scene.rock_steps;
  }
  return out;
}

}  // namespace sluice
