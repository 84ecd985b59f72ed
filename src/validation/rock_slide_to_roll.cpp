#include "validation/rock_slide_to_roll.h"

#include <fmt/format.h>

#include "validation/rock_scenes.h"

namespace sluice {

void RockSlideToRoll::keys(Schema& s) {
  s.number("stiffness_per_size", stiffness_per_size, {.unit = "N/m2", .above = 0, .doc = "k_n over size"});
  s.number("size", size, {.unit = "m", .above = 0, .doc = "diameter"});
  s.number("steps_per_contact", steps_per_contact, {.at_least = 5, .doc = "time steps in one contact"});
  s.number("seconds", seconds, {.unit = "s", .above = 0, .doc = "when speed and place are read"});
}

Measured RockSlideToRoll::run(const CsvTable& reference) const {
  const std::vector<double> friction = reference_numbers(reference, "friction");
  const std::vector<double> start = reference_numbers(reference, "speed0");
  const std::vector<double> time = reference_numbers(reference, "roll_time");
  const std::vector<double> speed = reference_numbers(reference, "roll_speed");
  const std::vector<double> place = reference_numbers(reference, "roll_place");
  Measured out;
  for (std::size_t k = 0; k < friction.size(); ++k) {
    RockSetup setup;
    setup.pair = {0.3, friction[k], 0};
    setup.smallest = setup.largest = size;
    setup.stiffness_per_size = stiffness_per_size;
    setup.gravity = {0, 0, -9.81};
    RockScene scene(setup, {level_wall(setup, 0)});
    const double rest = scene.dem->mass_of(0, 0, size) * 9.81 / (stiffness_per_size * size);  // overlap
    scene.dem->add({.x = {0, 0, 0.5 * size - rest}, .v = {start[k], 0, 0}, .size = size});
    scene.prime();
    const double dt = scene.dem->limits().contact_time / steps_per_contact;
    const auto steps = static_cast<std::int64_t>(std::ceil(seconds / dt));
    for (std::int64_t n = 0; n < steps; ++n) scene.step(seconds / static_cast<double>(steps));
    const double rolled = place[k] + speed[k] * (seconds - time[k]);
    out.values.push_back({fmt::format("speed over that of the start, mu = {}", friction[k]),
                          scene.rocks().v[0].x() / start[k], speed[k] / start[k], 1});
    out.values.push_back({fmt::format("place over that of rolling, mu = {}", friction[k]),
                          scene.rocks().x[0].x() / rolled, 1, 1});
    out.particle_steps += scene.rock_steps;
  }
  return out;
}

}  // namespace sluice
