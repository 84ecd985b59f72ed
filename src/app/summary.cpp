#include "app/summary.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cmath>
#include <fstream>

#include "analysis/mixing.h"
#include "app/exit_results.h"
#include "base/parallel.h"
#include "output/tables.h"
#include "sluice_version.h"

namespace sluice {

namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::int64_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

enum class Phase { rock, water, fines };

double left_through(const ExitTally& tally, Phase phase) {
  switch (phase) {
    case Phase::rock:
      return tally.rock_kg();
    case Phase::water:
      return tally.water_kg();
    case Phase::fines:
      return tally.fines_kg();
  }
  return 0;
}

BudgetEntry budget_of(const Parts& parts, Phase phase) {
  BudgetEntry b;
  b.initial_kg = phase == Phase::rock    ? parts.initial_rock_kg
                 : phase == Phase::water ? parts.initial_water_kg
                                         : parts.initial_fines_kg;
  for (const auto& inflow : parts.inflows) {
    const InflowBudget in = phase == Phase::rock    ? inflow->rock()
                            : phase == Phase::water ? inflow->water()
                                                    : inflow->fines();
    b.requested_kg += in.requested;
    b.entered_kg += in.entered;
    b.waiting_kg += in.waiting;
  }
  if (phase == Phase::rock)
    for (double m : parts.rocks->rocks().mass) b.inside_kg += m;
  else
    b.inside_kg = phase == Phase::water ? parts.water->total_mass() : parts.water->total_fines();
  for (const ExitTally& tally : parts.exits->tallies())
    b.left_kg.emplace_back(tally.config().name, left_through(tally, phase));
  b.left_kg.emplace_back("outside", left_through(parts.exits->outside(), phase));
  b.lost_kg = b.residual();
  return b;
}

/// Momentum inside less what came in, went out, and what gravity, walls and the other phase gave [N s].
std::array<double, 3> momentum_residual(const Parts& parts) {
  Vec3 residual = Vec3::Zero();
  const auto walls = [&](const std::vector<WallLoad>& loads) {
    for (const WallLoad& load : loads) residual += load.impulse;  // what the walls received
  };
  if (const DemSystem* rocks = parts.rocks.get()) {
    residual += rocks->momentum() - rocks->momentum_added() + rocks->momentum_removed() -
                rocks->impulse_from_gravity() - rocks->impulse_from_fluid();
    walls(rocks->wall_loads());
  }
  if (const FluidSystem* water = parts.water.get()) {
    residual += water->momentum() - water->momentum_added() + water->momentum_removed() -
                water->impulse_from_gravity();
    if (parts.coupling) residual -= parts.coupling->impulse_on_fluid();
    walls(water->wall_loads());
  }
  return {residual.x(), residual.y(), residual.z()};
}

NamedNumbers energy_terms(const Parts& parts) {
  NamedNumbers terms;
  if (parts.rocks) {
    const DemEnergy e = parts.rocks->energy();
    terms = {{"rock_kinetic_J", e.kinetic},
             {"rock_elastic_J", e.elastic},
             {"rock_potential_J", e.potential},
             {"rock_dissipated_normal_J", e.dissipated_normal},
             {"rock_dissipated_friction_J", e.dissipated_friction},
             {"rock_wall_work_J", e.wall_work},
             {"rock_fluid_work_J", e.fluid_work}};
  }
  if (parts.water) terms.emplace_back("water_kinetic_J", parts.water->kinetic_energy());
  return terms;
}

std::optional<double> known(double x) {
  return std::isfinite(x) ? std::optional<double>(x) : std::nullopt;
}

RunManifest::ExitSummary summary_of(const ExitResult& result, const ExitTally& tally, const Parts& parts) {
  RunManifest::ExitSummary s;
  s.name = result.name;
  s.rock_kg = parts.rocks ? known(tally.rock_kg()) : std::nullopt;
  s.water_kg = parts.water ? known(tally.water_kg()) : std::nullopt;
  s.steady_from_s = result.steady_from;
  if (!result.steady_from) return s;
  const ExitDistribution& d = result.distribution;
  if (parts.rocks) {
    s.rock_kg_s = known(d.all.rock_kg_s.value);
    s.rock_cov_across_width = known(d.rock.raw);
    s.rock_cov_corrected = known(d.rock.corrected);
    s.rock_size_p80_m = known(d.all.p80);
  }
  if (parts.water) {
    s.water_kg_s = known(d.all.water_kg_s.value);
    s.water_cov_across_width = known(d.water.raw);
  }
  if (parts.rocks && parts.water) {
    s.water_to_rock_cov = known(d.water_to_rock.raw);
    s.water_m3_per_t = known(d.all.m3_per_tonne);
    s.dry_rock_fraction = known(d.all.dry_share);
  }
  return s;
}

void fill_clock(RunManifest& m, const RunState& run) {
  const Simulation& simulation = run.simulation;
  const Parts& parts = simulation.parts();
  m.time.simulated_s = simulation.time();
  m.time.wall_s = run.wall_seconds;
  m.time.steps = static_cast<std::int64_t>(simulation.steps());
  m.time.planned_s = run.source.config.duration;
  if (parts.water) {
    m.time.dt_fluid_s = simulation.time_step().dt_fluid();
    m.time.fluid_steps = m.time.steps * simulation.time_step().fluid_substeps;
    m.time.fluid_step_governed_by = parts.water->limits().governed_by;
  }
  if (parts.rocks) {
    m.time.dt_rock_s = simulation.time_step().dt_rock();
    m.time.rock_steps = m.time.steps * simulation.time_step().rock_substeps;
    m.time.rock_step_governed_by = parts.rocks->limits().governed_by;
  }
}

void fill_rates(RunManifest& m, const Simulation& simulation) {
  double rock_seconds = 0, water_seconds = 0;
  for (const Stage& stage : simulation.stages()) {
    if (stage.name.rfind("rocks.", 0) == 0) rock_seconds += stage.seconds;
    if (stage.name.rfind("water.", 0) == 0) water_seconds += stage.seconds;
    // Substeps of one kind appear several times in the list; the manifest adds them up.
    auto same =
        std::find_if(m.stages.begin(), m.stages.end(), [&](const auto& s) { return s.name == stage.name; });
    if (same == m.stages.end()) same = m.stages.insert(m.stages.end(), {stage.name, 0, 0});
    same->seconds += stage.seconds;
    same->calls += static_cast<std::int64_t>(stage.calls);
  }
  if (rock_seconds > 0) m.rates.rock_steps_per_s = simulation.rock_steps() / rock_seconds;
  if (water_seconds > 0) m.rates.water_point_steps_per_s = simulation.point_steps() / water_seconds;
}

void fill_warnings(RunManifest& m, const RunState& run, const std::vector<ExitResult>& exits) {
  const Parts& parts = run.simulation.parts();
  m.warnings = run.warnings;
  for (const auto& inflow : parts.inflows)
    if (const std::string warning = inflow->warning(); !warning.empty()) m.warnings.push_back(warning);
  const ExitTally& outside = parts.exits->outside();
  if (outside.rock_kg() > 0 || outside.water_kg() > 0)
    m.warnings.push_back(
        fmt::format("{:.4g} kg of rock and {:.4g} kg of water left through open faces of the domain",
                    outside.rock_kg(), outside.water_kg()));
  for (const ExitResult& exit : exits)
    if (!exit.steady_from)
      m.warnings.push_back(
          fmt::format("exit '{}' has no steady averages: {}; exits.csv averages the second half of the run",
                      exit.name, exit.reason));
  if (m.overlap && m.overlap->max_percent_of_radius > 10)
    m.warnings.push_back(fmt::format("the largest overlap was {:.1f} % of a radius: raise rocks.impact_speed",
                                     m.overlap->max_percent_of_radius));
  if (parts.coupling && parts.coupling->smallest_kernel_ratio() > 0 &&
      parts.coupling->smallest_kernel_ratio() <
          run.source.config.coupling.value_or(CouplingConfig{}).kernel_diameters * (1 - 1e-9))
    m.warnings.push_back(
        fmt::format("the coupling kernel is only {:.1f} rock sizes wide for the largest rocks: the domain "
                    "holds no coarser level",
                    parts.coupling->smallest_kernel_ratio()));
}

ExitBinRow bin_row(const ExitResult& exit, std::size_t bin, const Parts& parts) {
  const ExitFigures& f = exit.distribution.bins[bin];
  const auto limits = [](const Estimate& e) {
    return TableEstimate{e.value, e.value - e.half_width, e.value + e.half_width};
  };
  const double seconds = exit.distribution.window.to - exit.distribution.window.from;
  ExitBinRow row;
  row.exit = exit.name;
  row.bin = static_cast<int>(bin);
  row.from_m = f.from;
  row.to_m = f.to;
  row.from_s = exit.distribution.window.from;
  row.to_s = exit.distribution.window.to;
  if (parts.rocks) {
    row.rock_kg_s = limits(f.rock_kg_s);
    row.rock_speed_m_s = f.rock_speed;
    row.rock_size_mean_m = f.size_mean;
    row.rock_size_p80_m = f.p80;
    row.rock_energy_W = seconds > 0 ? f.energy_per_rock * f.rock_count / seconds : not_known;
    row.rock_residence_s = f.residence;
  }
  if (parts.water) {
    row.water_kg_s = limits(f.water_kg_s);
    row.fines_kg_s = f.fines_kg_s;
    row.water_speed_m_s = f.water_speed;
  }
  if (parts.rocks && parts.water) {
    row.water_m3_per_t = {f.m3_per_tonne, not_known, not_known};
    row.dry_rock_kg_s = f.dry_share * f.rock_kg_s.value;
  }
  return row;
}

}  // namespace

RunManifest make_manifest(const RunState& run, Outcome outcome,
                          const std::optional<RunManifest::Failure>& failure) {
  const Simulation& simulation = run.simulation;
  const Parts& parts = simulation.parts();
  RunManifest m;
  m.sluice = {program_version, program_commit, program_compiler, program_flags};
  m.process = {run.source.file.string(), run.source.sha256, run.source.config.title};
  m.machine = {thread_count(), processor_name()};
  m.outcome = outcome;
  m.failure = failure;
  fill_clock(m, run);
  m.parts.present = parts.present();
  m.parts.left_out = parts.left_out();
  m.counts.wall_triangles = static_cast<std::int64_t>(parts.walls->mesh().triangles.size());
  if (parts.rocks) {
    m.counts.rocks = static_cast<std::int64_t>(parts.rocks->rocks().count());
    m.counts.rocks_max = static_cast<std::int64_t>(simulation.rocks_max());
    m.budgets.rock = budget_of(parts, Phase::rock);
    m.overlap = RunManifest::Overlap{parts.rocks->overlap_mean(), parts.rocks->overlaps().quantile(0.99),
                                     parts.rocks->overlap_max()};
    m.memory.rock_bytes = static_cast<std::int64_t>(parts.rocks->memory_bytes());
  }
  if (parts.water) {
    m.counts.water_points = static_cast<std::int64_t>(parts.water->count());
    m.counts.water_points_max = static_cast<std::int64_t>(simulation.points_max());
    m.budgets.water = budget_of(parts, Phase::water);
    m.budgets.fines = budget_of(parts, Phase::fines);
    m.memory.fluid_bytes = static_cast<std::int64_t>(parts.water->memory_bytes());
  }
  m.memory.peak_bytes = peak_bytes();
  m.budgets.momentum_residual_N_s = momentum_residual(parts);
  m.budgets.energy = energy_terms(parts);
  fill_rates(m, simulation);
  const std::vector<ExitResult> exits = exit_results(simulation);
  for (std::size_t i = 0; i < exits.size(); ++i)
    m.exits.push_back(summary_of(exits[i], parts.exits->tallies()[i], parts));
  m.state_hash = fmt::format("{:016x}", simulation.state_hash());
  fill_warnings(m, run, exits);
  return m;
}

void write_summary(const RunFolder& folder, const RunState& run, Outcome outcome,
                   const std::optional<RunManifest::Failure>& failure) {
  const Parts& parts = run.simulation.parts();
  std::vector<ExitBinRow> bins;
  for (const ExitResult& exit : exit_results(run.simulation))
    for (std::size_t bin = 0; bin < exit.distribution.bins.size(); ++bin)
      bins.push_back(bin_row(exit, bin, parts));
  write_csv(folder.exits(), exit_table(bins));

  std::vector<MixingTableRow> mixing;
  for (const auto& probe : parts.probes) {
    const auto* mixer = dynamic_cast<const MixingProbe*>(probe.get());
    if (!mixer) continue;
    for (const MixingRow& r : mixer->rows())
      mixing.push_back({r.t, mixer->name(), r.position, r.rock_kg, r.water_kg, r.lacey, r.rsd, r.wetted});
  }
  write_csv(folder.mixing(), mixing_table(mixing));

  std::vector<WallRow> walls;
  for (std::size_t w = 0; w < parts.walls->size(); ++w) {
    const Wall& wall = parts.walls->all()[w];
    WallRow row;
    row.wall = wall.name;
    for (std::size_t t = 0; t < wall.mesh.triangles.size(); ++t)
      row.area_m2 += wall.mesh.area(static_cast<int>(t));
    row.time_s = run.simulation.time();
    if (parts.rocks) row.rock = parts.rocks->wall_loads()[w];
    if (parts.water) row.water = parts.water->wall_loads()[w];
    walls.push_back(row);
  }
  write_csv(folder.walls(), wall_table(walls));
  write_manifest(folder.manifest(), make_manifest(run, outcome, failure));
}

std::vector<ViewMark> view_marks(const ProcessConfig& config) {
  std::vector<ViewMark> marks;
  for (const ExitConfig& exit : config.exits)
    if (exit.kind != ExitKind::deck) marks.push_back({exit.name, "exit", exit.low, exit.high});
  return marks;
}

}  // namespace sluice
