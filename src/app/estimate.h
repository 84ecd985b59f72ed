#pragma once
/// What a run will cost, before it is made: counts, memory and time, with the assumptions stated.

#include "processes/process_config.h"
#include "simulation/simulation.h"

namespace sluice {

struct RunEstimate {
  double residence = 0;                                 ///< assumed time that rock and water stay [s]
  double rocks = 0;                                     ///< inside at once
  double water_points = 0;                              ///< inside at once
  double rock_steps = 0;                                ///< over the run
  double point_steps = 0;                               ///< over the run
  double wall_steps = 0;                                ///< the water's cells of walls that move, times steps
  double memory_bytes = 0;                              ///< of rocks, water and walls
  double seconds = 0;                                   ///< of run time, with the rates below
  double rock_rate = 0, point_rate = 0, wall_rate = 0;  ///< assumed: such steps per second
};

/// Residence: twice the free fall through the domain's height plus a second. Rates: measured on the
/// development machine (2 threads, feed-box scene); another machine differs.
RunEstimate estimate_run(const ProcessConfig& config, const Simulation& simulation);
void print_estimate(const RunEstimate& estimate);
void print_parts(const Parts& parts);  ///< "parts: rocks, 3 walls; left out: water"

}  // namespace sluice
