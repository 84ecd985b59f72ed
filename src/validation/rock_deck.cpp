#include "validation/rock_deck.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "validation/rock_scenes.h"

namespace sluice {

namespace {

constexpr double flatness = 0.25;  // wide enough that friction on its face does not tip it
constexpr double g = 9.81;
constexpr double degree = std::numbers::pi / 180;

}  // namespace

void RockDeck::keys(Schema& s) {
  s.number("stiffness_per_size", stiffness_per_size, {.unit = "N/m2", .above = 0, .doc = "k_n over size"});
  s.number("size", size,
           {.unit = "m", .above = 0, .doc = "diameter, or edge of the block, four times its height"});
  s.number("blockiness", blockiness, {.at_least = 2, .at_most = 16, .doc = "2 is a ball, 8 a block"});
  s.number("restitution", restitution, {.above = 0, .at_most = 1, .doc = "of rock and deck"});
  s.number("steps_per_contact", steps_per_contact, {.at_least = 5, .doc = "time steps in one contact"});
  s.integer("periods_before", periods_before, {.at_least = 0, .doc = "of the deck, before it is measured"});
  s.integer("periods", periods, {.at_least = 1, .doc = "of the deck, while it is measured"});
}

Measured RockDeck::run(const CsvTable& reference) const {
  const std::vector<double> tilt = reference_numbers(reference, "tilt");
  const std::vector<double> friction = reference_numbers(reference, "friction");
  const std::vector<double> throw_angle = reference_numbers(reference, "throw_angle");
  const std::vector<double> frequency = reference_numbers(reference, "frequency");
  const std::vector<double> stroke = reference_numbers(reference, "stroke");
  const std::vector<double> speed = reference_numbers(reference, "speed");
  const bool ball = blockiness == 2;
  Measured out;
  for (std::size_t k = 0; k < tilt.size(); ++k) {
    RockSetup setup;
    setup.pair = {restitution, friction[k], 0};
    setup.smallest = setup.largest = size;
    setup.stiffness_per_size = stiffness_per_size;
    if (!ball) setup.shapes = {make_superquadric(1, flatness, blockiness)};
    setup.gravity = g * Vec3(std::sin(tilt[k] * degree), 0, -std::cos(tilt[k] * degree));
    Wall deck = level_wall(setup, 0);
    deck.motion = WallMotion{};
    deck.motion->direction = Vec3(std::cos(throw_angle[k] * degree), 0, std::sin(throw_angle[k] * degree));
    deck.motion->frequency = frequency[k];
    deck.motion->stroke = stroke[k];
    RockScene scene(setup, {deck});
    const double rest = scene.dem->mass_of(0, 0, size) * -setup.gravity.z() / (stiffness_per_size * size);
    scene.dem->add({.x = {0, 0, 0.5 * (ball ? 1 : flatness) * size - rest}, .size = size});

    // whole steps in a period
    const double period = 1 / frequency[k];
    const double dt = scene.dem->limits().contact_time / steps_per_contact;
    const auto steps = static_cast<std::int64_t>(std::ceil(period / dt));
    const auto run_for = [&](std::int64_t count) {
      for (std::int64_t n = 0; n < count * steps; ++n) scene.step(period / static_cast<double>(steps));
    };
    run_for(periods_before);
    const double from = scene.rocks().x[0].x();
    run_for(periods);
    const double along = (scene.rocks().x[0].x() - from) / (static_cast<double>(periods) * period);
    const double deck_speed = std::numbers::pi * frequency[k] * stroke[k] * deck.motion->direction.x();
    out.values.push_back({fmt::format("speed [m/s], tilt {}, friction {}, {:.3g} mm at {} degrees, {} Hz",
                                      tilt[k], friction[k], 1e3 * stroke[k], throw_angle[k], frequency[k]),
                          along, speed[k], deck_speed});
    out.particle_steps += scene.rock_steps;
  }
  return out;
}

}  // namespace sluice
