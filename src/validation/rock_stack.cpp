#include "validation/rock_stack.h"

#include <fmt/format.h>

#include "validation/rock_scenes.h"

namespace sluice {

void RockStack::keys(Schema& s) {
  s.number("time_step", time_step, {.unit = "s", .above = 0, .doc = "time step"});
}

Measured RockStack::run(const CsvTable& reference) const {
  const std::vector<double> time = reference_numbers(reference, "t");
  const std::array<std::vector<double>, 2> y{reference_numbers(reference, "y1"),
                                             reference_numbers(reference, "y2")};
  constexpr double diameter = 1e-3, ceiling = 1.8e-3, k_n = 1000;  // [m], [m], [N/m]
  constexpr double swing = 2.2e-5;                                 // amplitude of the lower ball [m]
  RockSetup setup;
  setup.rocks = {{"below", 20000}, {"above", 10000}};
  setup.pair = {1, 0, 0};
  setup.smallest = setup.largest = diameter;
  setup.stiffness_per_size = k_n / diameter;
  setup.gravity = {0, 0, -9.81};
  RockScene scene(setup, {level_wall(setup, 0, 1), level_wall(setup, ceiling, 1)});
  for (int ball = 0; ball < 2; ++ball)
    scene.dem->add({.x = {0, 0, y[static_cast<std::size_t>(ball)][0]}, .material = ball, .size = diameter});
  scene.prime();
  Measured out;
  for (std::size_t k = 1; k < time.size(); ++k) {
    const double from = scene.t, span = time[k] - from;
    const auto steps = static_cast<std::int64_t>(std::ceil(span / time_step - 1e-9));
    for (std::int64_t n = 0; n < steps; ++n) scene.step(span / static_cast<double>(steps));
    scene.t = from + span;
    for (std::size_t ball = 0; ball < 2; ++ball)
      out.values.push_back({fmt::format("height of ball {} at {} ms [m]", ball + 1, 1e3 * time[k]),
                            scene.rocks().x[ball].z(), y[ball][k], swing});
  }
  out.particle_steps = scene.rock_steps;
  return out;
}

}  // namespace sluice
