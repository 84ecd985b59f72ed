#include "validation/coupling_turning.h"

#include <fmt/format.h>

#include <cmath>

#include "base/errors.h"
#include "validation/coupling_scenes.h"

namespace sluice {

void CouplingTurning::keys(Schema& s) {
  s.number("spacing_diameters", spacing_diameters,
           {.above = 0, .doc = "grid spacing over the rod's thickness"});
  s.number("thickness", thickness, {.unit = "m", .above = 0, .doc = "of the rod"});
  s.number("elongation", elongation, {.at_least = 1, .at_most = 4, .doc = "length over thickness"});
  s.number("density", density, {.unit = "kg/m3", .above = 0, .doc = "of the rod"});
  s.number("fluid_density", fluid_density, {.unit = "kg/m3", .above = 0, .doc = "of the liquid"});
  s.number("viscosity", viscosity, {.unit = "Pa s", .above = 0, .doc = "of the liquid"});
  s.number("tilt", tilt, {.unit = "rad", .doc = "between the way down and the rod's axis at first"});
  s.number("depth", depth, {.unit = "m", .above = 0, .doc = "of the liquid"});
}

Measured CouplingTurning::run(const CsvTable& reference) const {
  const std::vector<double> time = reference_numbers(reference, "time");
  const std::vector<double> angle = reference_numbers(reference, "angle");
  constexpr double g = 9.81;
  const double h = spacing_diameters * thickness;
  const double width = h * std::ceil(std::max(4.0, 16 * thickness / h));
  ImmersedSetup setup;
  setup.rock_density = density;
  setup.rock_size = thickness;
  setup.rock_shape = make_superquadric(elongation, 1, 2);
  setup.coupling.mode = CouplingMode::one_way;
  setup.coupling.drag = DragModel::hoelzer_sommerfeld;
  setup.coupling.torque = CouplingTorque::centre_of_pressure;
  setup.water.config.spacing = h;
  setup.water.config.fastest_bulk_speed = 1;
  setup.water.config.deepest = depth;
  setup.water.config.fluid.density = fluid_density;
  setup.water.config.fluid.viscosity = viscosity;
  setup.water.gravity = {0, 0, -g};
  setup.water.domain = water_domain({Vec3(0, 0, -h), Vec3(width, width, depth + 8 * h)}, {true, true, false});
  ImmersedScene scene(setup, {sheet("floor", {Vec3(-width, -width, 0), Vec3(2 * width, -width, 0),
                                              Vec3(2 * width, 2 * width, 0), Vec3(-width, 2 * width, 0)})});
  const double c = scene.fluid.water->limits().sound_speed;
  WaterFill fill;
  fill.box = {Vec3::Zero(), Vec3(width, width, depth)};
  fill.pressure = [&](const Vec3& x) { return still_pressure(fluid_density, g, c, depth - x.z()); };
  scene.fluid.fill(fill);
  const Vec3 axis(std::sin(tilt), 0, -std::cos(tilt));
  scene.rocks->add({.x = {0.5 * width, 0.5 * width, depth - 2 * elongation * thickness},
                    .q = Quat::FromTwoVectors(Vec3::UnitX(), axis),
                    .size = thickness});
  const auto angle_now = [&] {
    const Vec3 now = scene.rocks->rocks().q[0] * Vec3::UnitX();
    return std::atan2(now.x(), -now.z());
  };
  Measured out;
  for (std::size_t k = 0; k < time.size(); ++k) {
    double before = angle_now(), from = scene.fluid.t;
    while (scene.fluid.t < time[k]) {
      before = angle_now();
      from = scene.fluid.t;
      scene.step();
      if (scene.rocks->rocks().x[0].z() < elongation * thickness)
        throw NumericalError("turning", scene.fluid.t, "the rod is at the floor", "make the liquid deeper");
    }
    const double share = scene.fluid.t > from ? (time[k] - from) / (scene.fluid.t - from) : 1;
    const double there = before + share * (angle_now() - before);
    out.values.push_back({fmt::format("angle after {} s [rad]", time[k]), there, angle[k], 1});
  }
  out.particle_steps = scene.fluid.point_steps;
  return out;
}

}  // namespace sluice
