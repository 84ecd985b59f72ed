#include "validation/rock_rotation.h"

#include <fmt/format.h>

#include "validation/rock_scenes.h"

namespace sluice {

void RockRotation::keys(Schema& s) {
  s.number("time_step", time_step, {.unit = "s", .above = 0, .doc = "time step"});
}

Measured RockRotation::run(const CsvTable& reference) const {
  const std::vector<std::string> name = reference_texts(reference, "case");
  const std::vector<double> time = reference_numbers(reference, "t");
  std::vector<Vec3> w(time.size());
  const std::array<const char*, 3> columns{"wx", "wy", "wz"};
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> along = reference_numbers(reference, columns[static_cast<std::size_t>(axis)]);
    for (std::size_t k = 0; k < w.size(); ++k) w[k][axis] = along[k];
  }
  Measured out;
  for (std::size_t first = 0; first < name.size();) {
    RockSetup setup;
    setup.smallest = setup.largest = 0.04;
    setup.shapes = {make_superquadric(1.5, 0.5, 2)};
    RockScene scene(setup, {});
    scene.dem->add({.w = w[first], .size = setup.largest});
    std::size_t k = first + 1;
    for (; k < name.size() && name[k] == name[first]; ++k) {
      const double span = time[k] - scene.t;
      const auto steps = static_cast<std::int64_t>(std::ceil(span / time_step - 1e-9));
      const double from = scene.t;
      for (std::int64_t n = 0; n < steps; ++n) scene.step(span / static_cast<double>(steps));
      scene.t = from + span;
      const Vec3 seen = scene.rocks().q[0].conjugate() * scene.rocks().w[0];
      for (int axis = 0; axis < 3; ++axis)
        out.values.push_back(
            {fmt::format("{}, {} at {} s", name[first], columns[static_cast<std::size_t>(axis)], time[k]),
             seen[axis], w[k][axis], w[first].norm()});
    }
    out.particle_steps += scene.rock_steps;
    first = k;
  }
  return out;
}

}  // namespace sluice
