#include "validation/coupling_third_law.h"

#include "base/random.h"
#include "validation/coupling_scenes.h"

namespace sluice {

void CouplingThirdLaw::keys(Schema& s) {
  s.integer("rocks", rocks, {.at_least = 1, .doc = "rocks in the box"});
  s.integer("steps", steps, {.at_least = 1, .doc = "fluid steps"});
  s.choice("precision", precision, {{"single", Precision::single}, {"reference", Precision::reference}},
           {.doc = "single or reference"});
}

Measured CouplingThirdLaw::run(const CsvTable& reference) const {
  constexpr double edge = 0.32, h = 0.04;  // [m]
  ImmersedSetup setup;
  setup.water.config.spacing = h;
  setup.water.config.fastest_bulk_speed = 1;
  setup.water.config.keep_tension = true;
  setup.water.config.precision = precision;
  setup.water.domain = water_domain({Vec3::Zero(), Vec3::Constant(edge)}, {true, true, true});
  ImmersedScene scene(setup, {});
  WaterFill fill;
  fill.box = setup.water.domain.box;
  scene.fluid.fill(fill);
  Random random(3);
  for (std::int64_t placed = 0; placed < rocks;) {
    const Vec3 x = edge * Vec3(random.uniform(), random.uniform(), random.uniform());
    const Vec3 v = random.on_sphere();
    if (!scene.rocks->has_room(x, 0.5 * setup.rock_size, false)) continue;
    scene.rocks->add({.x = x, .v = v, .size = setup.rock_size});
    ++placed;
  }
  const Vec3 before = scene.rocks->momentum() + scene.fluid.water->momentum();
  for (std::int64_t n = 0; n < steps; ++n) scene.step();
  const Vec3 after = scene.rocks->momentum() + scene.fluid.water->momentum();
  Measured out;
  out.particle_steps = scene.fluid.point_steps;
  out.values.push_back({"momentum gained over the sum of impulses exchanged",
                        (after - before).norm() / scene.exchanged,
                        reference_numbers(reference, "residual").front(), 1});
  return out;
}

}  // namespace sluice
