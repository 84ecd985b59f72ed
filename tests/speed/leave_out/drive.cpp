/// Steps a process whole, or one of its parts alone: for scripts/leave_out.sh, which counts what either
/// executes. Usage: leave_out whole|rocks|water STEPS PROCESS [key=value]... Prints the state's hash, the
/// heap's bytes in use, the length of a step [s] and its substeps.

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "processes/build_parts.h"
#include "simulation/simulation.h"

namespace {

using namespace sluice;

void say(std::uint64_t hash, const TimeStep& step) {
  fmt::print("{:016x} {} {:.17g} {}\n", hash, mallinfo2().uordblks, step.dt,
             std::max(step.rock_substeps, step.fluid_substeps));
}

/// The rocks, moved by nothing but their own system.
void step_rocks(DemSystem& rocks, const TimeStep& step, int steps) {
  for (int k = 0; k < steps; ++k) rocks.steps(k * step.dt, step.dt_rock(), step.rock_substeps);
  say(rocks.state_hash(), step);
}

/// The water, moved by nothing but its own system.
void step_water(FluidSystem& water, const TimeStep& step, int steps) {
  const double dt = step.dt_fluid();
  for (int k = 0; k < steps; ++k)
    for (int substep = 0; substep < step.fluid_substeps; ++substep) {
      water.points_to_grid(k * step.dt + substep * dt, dt);
      water.walls(dt);
      water.grid_to_points(dt);
    }
  say(water.state_hash(), step);
}

void step_whole(Parts parts, int steps) {
  Simulation simulation(std::move(parts));
  for (int k = 0; k < steps; ++k) simulation.step();
  say(simulation.state_hash(), simulation.time_step());
}

void drive(const std::vector<std::string>& words) {
  if (words.size() < 3) throw std::invalid_argument("give whole|rocks|water, the steps and the process");
  Parts parts = build_parts(read_process(words[2], {words.begin() + 3, words.end()})).parts;
  const int steps = std::stoi(words[1]);
  const TimeStep step = choose_time_step(parts);
  if (words[0] == "whole")
    step_whole(std::move(parts), steps);
  else if (words[0] == "rocks" && parts.rocks)
    step_rocks(*parts.rocks, step, steps);
  else if (words[0] == "water" && parts.water)
    step_water(*parts.water, step, steps);
  else
    throw std::invalid_argument("there is no part '" + words[0] + "'");
}

}  // namespace

int main(int count, char** words) {
  try {
    drive({words + 1, words + count});
    return EXIT_SUCCESS;
  } catch (const std::exception& e) {
    fmt::print(stderr, "leave_out: {}\n", e.what());
    return EXIT_FAILURE;
  }
}
