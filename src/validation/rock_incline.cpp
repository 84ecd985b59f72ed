#include "validation/rock_incline.h"

#include <fmt/format.h>

#include <numbers>

#include "validation/rock_scenes.h"

namespace sluice {

void RockIncline::keys(Schema& s) {
  s.number("stiffness_per_size", stiffness_per_size, {.unit = "N/m2", .above = 0, .doc = "k_n over size"});
  s.number("size", size, {.unit = "m", .above = 0, .doc = "diameter or edge"});
  s.number("blockiness", blockiness, {.at_least = 2, .at_most = 16, .doc = "2 is a ball, 8 a block"});
  s.number("steps_per_contact", steps_per_contact, {.at_least = 5, .doc = "time steps in one contact"});
  s.number("seconds", seconds, {.unit = "s", .above = 0, .doc = "how long it runs"});
}

Measured RockIncline::run(const CsvTable& reference) const {
  const std::vector<double> angle = reference_numbers(reference, "angle");
  const std::vector<double> friction = reference_numbers(reference, "friction");
  const std::vector<double> acceleration = reference_numbers(reference, "acceleration");
  const bool ball = blockiness == 2;
  const std::vector<double> spin = ball ? reference_numbers(reference, "spin") : std::vector<double>();
  constexpr double g = 9.81;
  Measured out;
  for (std::size_t k = 0; k < angle.size(); ++k) {
    const double tilt = angle[k] * std::numbers::pi / 180;
    RockSetup setup;
    setup.pair = {0.3, friction[k], 0};
    setup.smallest = setup.largest = size;
    setup.stiffness_per_size = stiffness_per_size;
    setup.gravity = g * Vec3(std::sin(tilt), 0, -std::cos(tilt));
    if (!ball) setup.shapes = {make_superquadric(1, 1, blockiness)};
    RockScene scene(setup, {level_wall(setup, 0)});
    const double rest = scene.dem->mass_of(0, 0, size) * g * std::cos(tilt) / (stiffness_per_size * size);
    scene.dem->add({.x = {0, 0, 0.5 * size - rest}, .size = size});
    scene.prime();
    const double dt = scene.dem->limits().contact_time / steps_per_contact;
    const auto steps = static_cast<std::int64_t>(std::ceil(seconds / dt));
    for (std::int64_t n = 0; n < steps; ++n) scene.step(seconds / static_cast<double>(steps));
    const std::string where = fmt::format("at {} degrees, mu = {}", angle[k], friction[k]);
    out.values.push_back({"acceleration over g " + where,
                          2 * scene.rocks().x[0].x() / (g * seconds * seconds), acceleration[k] / g, 1});
    if (ball)
      out.values.push_back({"R x spin rate over g " + where,
                            0.5 * size * scene.rocks().w[0].y() / (g * seconds), spin[k] / g, 1});
    out.particle_steps += scene.rock_steps;
  }
  return out;
}

}  // namespace sluice
