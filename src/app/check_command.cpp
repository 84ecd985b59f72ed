#include <fmt/format.h>

#include <cmath>

#include "app/commands.h"
#include "app/estimate.h"
#include "app/process_source.h"
#include "base/units.h"
#include "geometry/audit_mesh.h"
#include "processes/build_parts.h"
#include "simulation/simulation.h"

namespace sluice {

namespace {

void print_audit(const Walls& walls) {
  fmt::print("\n{:<24} {:>9} {:>9} {:>7} {:>6} {:>6} {:>6} {:>6} {:>9}  {}\n", "wall", "triangles", "area m2",
             "closed", "loops", "degen", "dupl", "cross", "material", "bounds m");
  for (const Wall& wall : walls.all())
    for (const PartAudit& a : audit_mesh(wall.mesh))
      fmt::print(
          "{:<24} {:>9} {:>9.3f} {:>7} {:>6} {:>6} {:>6} {:>6} {:>9}  [{:.2f} {:.2f} {:.2f}] .. [{:.2f} "
          "{:.2f} {:.2f}]\n",
          wall.name, a.triangles, a.area, a.closed ? "yes" : "sheet", a.boundary_loops, a.degenerate,
          a.duplicates, a.self_intersections, wall.material, a.bounds.lo.x(), a.bounds.lo.y(),
          a.bounds.lo.z(), a.bounds.hi.x(), a.bounds.hi.y(), a.bounds.hi.z());
}

/// How fast the moving walls are, and how well the rocks' step follows them.
void print_motions(const Simulation& simulation) {
  constexpr double standard_gravity = 9.80665;  // [m/s2]
  const double dt = simulation.time_step().dt_rock();
  for (const Wall& wall : simulation.parts().walls->all()) {
    if (!wall.motion) continue;
    const MotionRange range = motion_range(*wall.motion, wall.mesh.vertices);
    const double period = shortest_time(*wall.motion);
    fmt::print("{} moves: at most {:.3g} m/s and {:.3g} g", wall.name, range.speed,
               range.acceleration / standard_gravity);
    if (dt > 0) fmt::print(", {:.3g} s a period or turn = {:.0f} steps", period, period / dt);
    fmt::print("\n");
  }
}

void print_steps(const Simulation& simulation) {
  const TimeStep& step = simulation.time_step();
  fmt::print("\nscene step {:.3e} s", step.dt);
  if (step.rock_substeps > 0) fmt::print(", {} rock substeps", step.rock_substeps);
  if (step.fluid_substeps > 1) fmt::print(", {} water substeps", step.fluid_substeps);
  fmt::print("\n");
  if (const DemSystem* rocks = simulation.parts().rocks.get()) {
    const DemStepLimits& l = rocks->limits();
    fmt::print("rocks: step {:.3e} s (from {}{}), shortest contact {:.3e} s = {:.0f} steps", l.step,
               l.governed_by, l.contact.empty() ? "" : " of " + l.contact, l.contact_time,
               l.contact_time / l.step);
    if (l.stiffness_per_size > 0)
      fmt::print(", k_n {:.3e} N/m per m of size (from {})", l.stiffness_per_size, l.stiffness_from);
    if (l.hertz_overlap > 0) fmt::print(", Hertz overlap to {:.2g} % of radius", 100 * l.hertz_overlap);
    fmt::print("\n");
  }
  if (const FluidSystem* water = simulation.parts().water.get()) {
    const FluidStepLimits& l = water->limits();
    fmt::print("water: step {:.3e} s (from {}), sound speed {:.1f} m/s, cell {:.1f} mm, point {:.3g} l\n",
               l.step, l.governed_by, l.sound_speed, 1e3 * water->spacing(), 1e3 * water->point_volume());
    const FluidModel& fluid = water->model();
    if (fluid.rheology != Rheology::newtonian)
      fmt::print(
          "water: yields at {:.3g} Pa, then {:.3g} Pa s^n at n = {:.3g}; regularised below {:.3g} 1/s "
          "(Papanastasiou), so at rest {:.3g} Pa s\n",
          fluid.yield_stress, fluid.viscosity, fluid.flow_index, fluid.yield_rate,
          largest_viscosity(fluid, 0));
  }
}

}  // namespace

int check_process(const CheckOptions& options) {
  const ProcessSource source = read_process_source(options.process, options.overrides);
  BuiltProcess built = build_parts(source.config);
  const std::vector<std::string> warnings = built.warnings;
  const Simulation simulation(std::move(built.parts));
  const Parts& parts = simulation.parts();
  fmt::print("{}\n{}\n", source.config.title, std::string(source.config.title.size(), '='));
  print_parts(parts);
  if (!parts.walls->empty()) print_audit(*parts.walls);
  print_steps(simulation);
  print_motions(simulation);
  print_estimate(estimate_run(source.config, simulation));
  for (const std::string& warning : warnings) fmt::print("warning: {}\n", warning);
  fmt::print("\n{}: no problem found\n", options.process.string());
  return 0;
}

}  // namespace sluice
