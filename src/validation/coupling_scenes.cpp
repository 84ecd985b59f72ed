#include "validation/coupling_scenes.h"

#include <cmath>

namespace sluice {

ImmersedScene::ImmersedScene(const ImmersedSetup& setup, std::vector<Wall> walls)
    : fluid(setup.water, std::move(walls)) {
  DemScene scene;
  scene.materials.all = {{"rock", setup.rock_density}};
  scene.materials.pairs = {setup.pair};
  scene.shapes = {setup.rock_shape};
  scene.domain = setup.water.domain;
  scene.gravity = setup.rock_gravity.value_or(setup.water.gravity);
  scene.smallest_size = scene.largest_size = setup.rock_size;
  scene.densest = setup.rock_density;
  DemConfig config;
  config.impact_speed = 1;
  rocks = std::make_unique<DemSystem>(config, scene, fluid.walls);
  coupling = std::make_unique<Coupling>(setup.coupling, setup.water.domain, setup.water.gravity, *rocks,
                                        *fluid.water);
}

void ImmersedScene::step() {
  const double dt = fluid.water->limits().step, from = fluid.t;
  if (coupling->resolves()) coupling->place_resolved(dt, 0, 1);
  coupling->solids_to_grid();
  fluid.step([&] { coupling->drag(dt); });
  coupling->fluid_to_grid(dt);
  if (coupling->resolves()) coupling->take_resolved(dt, 0, 1);
  for (std::size_t i = 0; i < rocks->rocks().count(); ++i) exchanged += dt * coupling->force()[i].norm();
  const int n = static_cast<int>(std::ceil(dt / rocks->step_size()));
  for (int k = 0; k < n; ++k) rocks->step(from + k * dt / n, dt / n);
}

}  // namespace sluice
