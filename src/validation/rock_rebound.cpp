#include "validation/rock_rebound.h"

#include <fmt/format.h>

#include "validation/rock_scenes.h"

namespace sluice {

void RockRebound::keys(Schema& s) {
  s.number("steps_per_contact", steps_per_contact, {.at_least = 3, .doc = "time steps in one contact"});
  s.choice("end_of_contact", end_of_contact,
           {{"no_tension", EndOfContact::no_tension}, {"tension", EndOfContact::tension}},
           {.doc = "whether the dashpot may pull at the end"});
  s.integer("arrivals", arrivals, {.at_least = 1, .doc = "phases of the step at which the sphere arrives"});
  s.number("damping_factor", damping_factor,
           {.above = 0, .doc = "over the damping that the restitution asks for; other than 1 is a fault"});
}

double restitution_with_damping(double restitution, double factor, EndOfContact end) {
  if (factor == 1) return restitution;
  const double wanted = factor * damping_ratio(restitution, end);
  double low = 1e-6, high = 1;  // damping falls with restitution
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (damping_ratio(middle, end) > wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Measured RockRebound::run(const CsvTable& reference) const {
  const std::vector<double> asked = reference_numbers(reference, "restitution");
  const std::vector<double> phase = reference_numbers(reference, "phase");
  constexpr double speed = 1;  // [m/s]
  Measured out;
  for (std::size_t k = 0; k < asked.size(); ++k) {
    RockSetup setup;
    setup.end = end_of_contact;
    setup.pair = {restitution_with_damping(asked[k], damping_factor, end_of_contact), 0, 0};
    double worst = asked[k];
    for (std::int64_t arrival = 0; arrival < arrivals; ++arrival) {
      RockScene scene(setup, {level_wall(setup, 0)});
      const double gap = (static_cast<double>(arrival) + 0.5) / static_cast<double>(arrivals);
      const double k_n = setup.stiffness_per_size * setup.largest;
      const double contact = phase[k] * std::sqrt(scene.dem->mass_of(0, 0, setup.largest) / k_n);
      const double dt = contact / steps_per_contact;
      scene.dem->add(
          {.x = {0, 0, 0.5 * setup.largest + gap * speed * dt}, .v = {0, 0, -speed}, .size = setup.largest});
      for (int n = 0; n < 3 * steps_per_contact + 3; ++n) scene.step(dt);
      const double rebound = scene.rocks().v[0].z() / speed;
      if (std::abs(rebound - asked[k]) > std::abs(worst - asked[k])) worst = rebound;
      out.particle_steps += scene.rock_steps;
    }
    out.values.push_back({fmt::format("restitution, {} asked", asked[k]), worst, asked[k], 1});
  }
  return out;
}

}  // namespace sluice
