#include "simulation/stages.h"

#include <cmath>

namespace sluice {

namespace {

SceneView view_of(const Parts& parts, const StepTime& time) {
  SceneView view;
  view.t = time.t + time.dt;
  view.dt = time.dt;
  view.rocks = parts.rocks.get();
  view.water = parts.water.get();
  view.walls = parts.walls.get();
  view.wetted_fraction = parts.coupling ? &parts.coupling->wetted_fraction() : nullptr;
  return view;
}

void look_through_probes(const Parts& parts, const StepTime& time) {
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
  const auto add = [&](const char* name, std::function<void(const StepTime&)> run) {
    stages.push_back({name, std::move(run), 0, 0});
  };

  if (!parts.inflows.empty())
    add("inflow", [&](const StepTime& s) {
      for (const auto& inflow : parts.inflows) inflow->advance(s.t, s.dt);
    });
  if (parts.coupling)
    add("coupling.solids_to_grid", [&](const StepTime&) { parts.coupling->solids_to_grid(); });
  // Where the rocks' step is the longer one the water subcycles; the coupling acts in its first substep.
  for (int k = 0; k < step.fluid_substeps; ++k) {
    const double dt = step.dt_fluid();
    const double offset = k * dt;
    add("water.points_to_grid",
        [&, dt, offset](const StepTime& s) { parts.water->points_to_grid(s.t + offset, dt); });
    if (parts.coupling && k == 0)
      add("coupling.drag", [&](const StepTime& s) { parts.coupling->drag(s.dt); });
    if (!parts.walls->empty()) add("water.walls", [&, dt](const StepTime&) { parts.water->walls(dt); });
    add("water.grid_to_points", [&, dt](const StepTime&) { parts.water->grid_to_points(dt); });
    if (parts.coupling && k == 0)
      add("coupling.fluid_to_grid", [&, dt](const StepTime&) { parts.coupling->fluid_to_grid(dt); });
  }
  if (parts.rocks)
    add("rocks.substeps", [&, step](const StepTime& s) {
      for (int k = 0; k < step.rock_substeps; ++k)
        parts.rocks->step(s.t + k * step.dt_rock(), step.dt_rock());
    });
  if (parts.exits)
    add("exits",
        [&](const StepTime& s) { parts.exits->collect(s.t + s.dt, parts.rocks.get(), parts.water.get()); });
  if (!parts.probes.empty()) add("probes", [&](const StepTime& s) { look_through_probes(parts, s); });
  return stages;
}

}  // namespace sluice
