#include "validation/coupling_jet.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "inflow/pipe_jet.h"
#include "validation/coupling_scenes.h"

namespace sluice {

void CouplingJet::keys(Schema& s) {
  s.number("cells", cells, {.at_least = 2, .doc = "grid cells across the jet"});
  s.number("bores", bores, {.at_least = 2, .doc = "width of the block over the jet's"});
  s.number("blockiness", blockiness, {.at_least = 2, .at_most = 16, .doc = "of the block"});
  s.number("resolve_from", resolve_from,
           {.at_least = 3, .doc = "of the coupling: from this size over the spacing on it is resolved"});
  s.number("passes", passes, {.above = 0, .doc = "bores that the jet runs; the last half is read"});
}

Measured CouplingJet::run(const CsvTable& reference) const {
  const std::vector<double> bore = reference_numbers(reference, "bore");
  const std::vector<double> speed = reference_numbers(reference, "speed");
  const std::vector<double> force = reference_numbers(reference, "force");
  Measured out;
  for (std::size_t k = 0; k < bore.size(); ++k) {
    const double d = bore[k], h = d / cells, width = bores * d;
    ImmersedSetup setup;
    setup.rock_density = 1e7;  // held: the jet does not move it
    setup.rock_size = width;
    setup.rock_shape = make_superquadric(1, 1, blockiness);
    setup.coupling.resolve_from = resolve_from;
    setup.coupling.resolve_partly_from = resolve_from;
    setup.water.config.spacing = h;
    setup.water.config.fastest_bulk_speed = speed[k];
    const double side = width, below = -2 * width, above = 3 * d;
    setup.water.domain =
        water_domain({Vec3(-side, -side, below), Vec3(side, side, above)}, {false, false, false});
    ImmersedScene scene(setup, {});
    // Not with its faces on nodes.
    const double top = -0.37 * h;
    scene.rocks->add({.x = {0.21 * h, -0.13 * h, top - 0.5 * width}, .size = width});
    PipeJetConfig config;
    config.name = "pipe";
    config.bore = d;
    config.outlets.position = {0, 0, 2 * d};
    config.outlets.direction = {0, 0, -1};
    config.outlets.flow = speed[k] * std::numbers::pi / 4 * d * d;
    InflowTarget target;
    target.water = scene.fluid.water.get();
    target.domain = setup.water.domain;
    const auto pipe = make_pipe_jet(config, target);
    const double until = passes * d / speed[k];
    double sum = 0, looks = 0;
    while (scene.fluid.t < until) {
      pipe->advance(scene.fluid.t, scene.fluid.water->limits().step);
      scene.step();
      scene.fluid.water->remove_outside();
      if (scene.fluid.t < 0.5 * until) continue;
      sum -= scene.coupling->force()[0].z();
      looks += 1;
    }
    out.particle_steps += scene.fluid.point_steps;
    out.values.push_back(
        {fmt::format("force, {} mm, {} m/s [N]", 1e3 * d, speed[k]), sum / looks, force[k], force[k]});
  }
  return out;
}

}  // namespace sluice
