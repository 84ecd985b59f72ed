#include "simulation/stages.h"

#include <cmath>

namespace sluice {

namespace {

SceneView view_of(const Parts& parts, const StepSpan& time) {
  SceneView view;
  view.t = time.t + time.dt;
  view.dt = time.dt;
  view.rocks = parts.rocks.get();
  view.water = parts.water.get();
  view.walls = parts.walls.get();
  return view;
}

void look_through_probes(const Parts& parts, const StepSpan& time) {
  const SceneView view = view_of(parts, time);
  for (const auto& probe : parts.probes) {
    // The step in which a multiple of the interval falls, whatever the step's length.
    const double before = std::floor(time.t / probe->interval() + 1e-9);
    const double after = std::floor(view.t / probe->interval() + 1e-9);
    if (after > before) probe->look(view);
  }
}

}  // namespace

std::vector<Stage> build_stages(Parts& parts, const TimeStep& step) {
  std::vector<Stage> stages;
  const auto add = [&](const char* name, std::function<void(const StepSpan&)> run) {
    stages.push_back({name, std::move(run), 0, 0});
  };

  if (!parts.inflows.empty())
    add("inflow", [&](const StepSpan& s) {
      for (const auto& inflow : parts.inflows) inflow->advance(s.t, s.dt);
    });
  if (parts.coupling)
    add("coupling.solids_to_grid", [&](const StepSpan&) { parts.coupling->solids_to_grid(); });
  // Where the rocks' step is the longer one the water subcycles; the coupling acts in its first substep.
  const int n = step.fluid_substeps;
  for (int k = 0; k < n; ++k) {
    const double dt = step.dt_fluid();
    const double offset = k * dt;
    const bool resolves = parts.coupling && parts.coupling->resolves();
    if (resolves)
      add("coupling.place_resolved",
          [&, k, n](const StepSpan& s) { parts.coupling->place_resolved(s.dt, k, n); });
    add("water.points_to_grid",
        [&, dt, offset](const StepSpan& s) { parts.water->points_to_grid(s.t + offset, dt); });
    if (parts.coupling && k == 0)
      add("coupling.drag", [&](const StepSpan& s) { parts.coupling->drag(s.dt); });
    // In a scene without walls too: it is where the fluid's nodes get their velocity.
    add("water.walls", [&, dt](const StepSpan&) { parts.water->walls(dt); });
    add("water.grid_to_points", [&, dt](const StepSpan&) { parts.water->grid_to_points(dt); });
    if (parts.coupling && k == 0)
      add("coupling.fluid_to_grid", [&, dt](const StepSpan&) { parts.coupling->fluid_to_grid(dt); });
    if (resolves)
      add("coupling.take_resolved",
          [&, k, n](const StepSpan& s) { parts.coupling->take_resolved(s.dt, k, n); });
  }
  if (parts.rocks)
    add("rocks.substeps",
        [&, step](const StepSpan& s) { parts.rocks->steps(s.t, step.dt_rock(), step.rock_substeps); });
  if (parts.exits)
    add("exits",
        [&](const StepSpan& s) { parts.exits->collect(s.t + s.dt, parts.rocks.get(), parts.water.get()); });
  if (!parts.probes.empty()) add("probes", [&](const StepSpan& s) { look_through_probes(parts, s); });
  return stages;
}

}  // namespace sluice
