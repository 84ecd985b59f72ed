#include "simulation/simulation.h"

#include <gtest/gtest.h>

#include "mpm/mpm_system.h"

namespace sluice {
namespace {

/// A cube of water in an open box, with nothing else.
Simulation free_water() {
  Parts parts;
  parts.domain.box = {Vec3::Zero(), Vec3(1, 1, 2)};
  MpmConfig config;
  config.spacing = 0.05;
  config.fastest_bulk_speed = 3;
  parts.water = make_mpm(config, parts.domain, parts.gravity, *parts.walls);
  const double step = 0.025;
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i) {
        NewPoint p;
        p.x = Vec3(0.4, 0.4, 1.5) + step * Vec3(i + 0.5, j + 0.5, k + 0.5);
        p.mass = parts.water->model().density * parts.water->point_volume();
        parts.water->add(p);
        parts.initial_water_kg += p.mass;
      }
  parts.exits.emplace(std::vector<ExitConfig>{}, *parts.walls, 0.1);
  return Simulation(std::move(parts));
}

TEST(Simulation, LetsWaterFallFreelyWhereThereIsNoWall) {
  Simulation simulation = free_water();
  while (simulation.time() < 0.1) simulation.step();
  const double expected = -9.81 * simulation.time() * simulation.parts().water->total_mass();
  EXPECT_NEAR(simulation.parts().water->momentum().z(), expected, 1e-5 * std::abs(expected));
  EXPECT_NEAR(simulation.parts().water->largest_speed(), 9.81 * simulation.time(), 0.02);
}

TEST(Simulation, CountsWaterThatLeavesThroughAnOpenFace) {
  Simulation simulation = free_water();
  while (simulation.time() < 0.7) simulation.step();
  const Parts& parts = simulation.parts();
  EXPECT_EQ(parts.water->count(), 0u);
  EXPECT_NEAR(parts.exits->outside().water_kg(), parts.initial_water_kg, 1e-12 * parts.initial_water_kg);
}

TEST(Simulation, NamesWhatItHasAndWhatItLeavesOut) {
  const Simulation simulation = free_water();
  EXPECT_EQ(simulation.parts().present(), std::vector<std::string>{"water"});
  EXPECT_EQ(simulation.parts().left_out(),
            (std::vector<std::string>{"rocks", "coupling", "walls", "inflow", "exits", "probes"}));
}

TEST(TimeStep, IsTheWatersWhereThereAreNoRocks) {
  const Simulation simulation = free_water();
  EXPECT_EQ(simulation.time_step().fluid_substeps, 1);
  EXPECT_EQ(simulation.time_step().rock_substeps, 0);
  EXPECT_DOUBLE_EQ(simulation.time_step().dt, simulation.parts().water->limits().step);
}

}  // namespace
}  // namespace sluice
