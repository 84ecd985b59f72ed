#include "validation/rock_bounces.h"

#include <fmt/format.h>

#include "validation/rock_scenes.h"

namespace sluice {

void RockBounces::keys(Schema& s) {
  s.number("stiffness_per_size", stiffness_per_size, {.unit = "N/m2", .above = 0, .doc = "k_n over size"});
  s.number("size", size, {.unit = "m", .above = 0, .doc = "diameter of the ball"});
  s.number("drop", drop, {.unit = "m", .above = 0, .doc = "from its lowest point to the floor"});
  s.number("steps_per_contact", steps_per_contact, {.at_least = 5, .doc = "time steps in one contact"});
}

Measured RockBounces::run(const CsvTable& reference) const {
  const std::vector<double> restitution = reference_numbers(reference, "restitution");
  const std::vector<double> bounce = reference_numbers(reference, "bounce");
  const std::vector<double> apex = reference_numbers(reference, "apex");
  Measured out;
  for (std::size_t first = 0; first < restitution.size();) {
    const double e = restitution[first];
    std::size_t end = first;
    while (end < restitution.size() && restitution[end] == e) ++end;
    RockSetup setup;
    setup.pair = {e, 0, 0};
    setup.smallest = setup.largest = size;
    setup.stiffness_per_size = stiffness_per_size;
    setup.gravity = {0, 0, -9.81};
    RockScene scene(setup, {level_wall(setup, 0)});
    const double dt =
        scene.dem->limits().contact_time * std::sqrt(2.0) / steps_per_contact;  // wall: m, not m/2
    scene.dem->add({.x = {0, 0, 0.5 * size + drop}, .size = size});
    std::size_t passed = 0;
    while (first < end) {
      const double z = scene.rocks().x[0].z(), v = scene.rocks().v[0].z();
      scene.step(dt);
      if (!(v > 0 && scene.rocks().v[0].z() <= 0)) continue;
      const double height = z + v * v / (2 * 9.81) - 0.5 * size;
      ++passed;
      if (static_cast<double>(passed) == bounce[first]) {
        out.values.push_back({fmt::format("apex over drop, bounce {} at e = {}", passed, e), height / drop,
                              apex[first] / drop, 1});
        ++first;
      }
    }
    out.particle_steps += scene.rock_steps;
  }
  return out;
}

}  // namespace sluice
