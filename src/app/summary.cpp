#include "app/summary.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cmath>
#include <fstream>

#include "analysis/budgets.h"
#include "analysis/mixing.h"
#include "app/exit_results.h"
#include "base/parallel.h"
#include "coupling/resolved_rocks.h"
#include "output/tables.h"
#include "sluice_version.h"

namespace sluice {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

namespace {

std::int64_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

/// What the feeds say of one phase joins what is inside and what left.
BudgetEntry budget_entry(const Parts& parts, PhaseBudget b, double initial,
                         InflowBudget (Inflow::*phase)() const) {
  b.initial = initial;
  for (const auto& inflow : parts.inflows) {
    const InflowBudget in = (inflow.get()->*phase)();
    b.requested += in.requested;
    b.entered += in.entered;
    b.waiting += in.waiting;
  }
  BudgetEntry entry{b.initial, b.requested, b.entered, b.waiting, b.inside, {}, b.lost()};
  for (const LeftMass& left : b.left) entry.left_kg.emplace_back(left.exit, left.kg);
  return entry;
}

/// Of both phases together [N s]: what they exchange cancels but for what the coupling itself counts.
std::array<double, 3> momentum_gap(const Parts& parts) {
  MomentumTerms terms;
  if (const DemSystem* rocks = parts.rocks.get()) {
    terms.now += rocks->momentum();
    terms.gravity += rocks->impulse_from_gravity();
    terms.entered += rocks->momentum_added();
    terms.left += rocks->momentum_removed();
    terms.to_walls += impulse_to_walls(rocks->wall_loads());
    terms.from_other += rocks->impulse_from_fluid();
  }
  if (const FluidSystem* water = parts.water.get()) {
    terms.now += water->momentum();
    terms.gravity += water->impulse_from_gravity();
    terms.entered += water->momentum_added();
    terms.left += water->momentum_removed();
    terms.to_walls += impulse_to_walls(water->wall_loads());
    if (parts.coupling) terms.from_other += parts.coupling->impulse_on_fluid();
  }
  const Vec3 gap = momentum_residual(terms);
  return {gap.x(), gap.y(), gap.z()};
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

/// Every figure of the exit over its window, of what the scene has.
RunManifest::ExitAverages averages_of(const ExitResult& result, const Parts& parts) {
  const ExitDistribution& d = result.distribution;
  RunManifest::ExitAverages a;
  a.from_s = d.window.from;
  a.to_s = d.window.to;
  a.steady = result.steady_from.has_value();
  a.reason = result.reason;
  const auto add = [&](const char* name, const Estimate& e) {
    a.figures.push_back({name, e.value, e.value - e.half_width, e.value + e.half_width});
  };
  const auto add_evenness = [&](const std::string& phase, const Evenness& e) {
    add((phase + "_cov_across_width").c_str(), {e.raw, e.raw_half_width});
    add((phase + "_cov_corrected").c_str(), {e.corrected, e.corrected_half_width});
  };
  if (parts.rocks) {
    add("rock_kg_s", d.all.rock_kg_s);
    add_evenness("rock", d.rock);
    add("rock_size_p80_m", d.all.p80);
    add("rock_speed_m_s", d.all.rock_speed);
    add("rock_energy_W", d.all.rock_power);
    add("rock_residence_s", d.all.residence);
  }
  if (parts.water) {
    add("water_kg_s", d.all.water_kg_s);
    add_evenness("water", d.water);
    add("water_speed_m_s", d.all.water_speed);
  }
  if (parts.rocks && parts.water) {
    add("water_to_rock_cov", {d.water_to_rock.raw, d.water_to_rock.raw_half_width});
    add("water_m3_per_t", d.all.m3_per_tonne);
    add("dry_rock_fraction", d.all.dry_share);
    add("fines_kg_s", d.all.fines_kg_s);
  }
  return a;
}

RunManifest::ExitSummary summary_of(const ExitResult& result, const ExitTally& tally, const Parts& parts) {
  RunManifest::ExitSummary s;
  s.name = result.name;
  s.rock_kg = parts.rocks ? known(tally.rock_kg()) : std::nullopt;
  s.water_kg = parts.water ? known(tally.water_kg()) : std::nullopt;
  s.steady_from_s = result.steady_from;
  s.averages = averages_of(result, parts);
  if (!result.steady_from) return s;
  const ExitDistribution& d = result.distribution;
  if (parts.rocks) {
    s.rock_kg_s = known(d.all.rock_kg_s.value);
    s.rock_cov_across_width = known(d.rock.raw);
    s.rock_cov_corrected = known(d.rock.corrected);
    s.rock_size_p80_m = known(d.all.p80.value);
  }
  if (parts.water) {
    s.water_kg_s = known(d.all.water_kg_s.value);
    s.water_cov_across_width = known(d.water.raw);
  }
  if (parts.rocks && parts.water) {
    s.water_to_rock_cov = known(d.water_to_rock.raw);
    s.water_m3_per_t = known(d.all.m3_per_tonne.value);
    s.dry_rock_fraction = known(d.all.dry_share.value);
  }
  return s;
}

void fill_clock(RunManifest& m, const RunState& run) {
  const Simulation& simulation = run.simulation;
  const Parts& parts = simulation.parts();
  m.time.simulated_s = simulation.time();
  m.time.wall_s = run.wall_seconds;
  m.time.steps = static_cast<std::int64_t>(simulation.steps());
  m.time.planned_s = run.planned;
  if (parts.water) {
    m.time.dt_fluid_s = simulation.time_step().dt_fluid();
    m.time.fluid_steps = m.time.steps * simulation.time_step().fluid_substeps;
    m.time.fluid_step_governed_by = parts.water->limits().governed_by;
  }
  if (parts.rocks) {
    m.time.dt_rock_s = simulation.time_step().dt_rock();
    m.time.rock_steps = m.time.steps * simulation.time_step().rock_substeps;
    const DemStepLimits& limits = parts.rocks->limits();
    m.time.rock_step_governed_by =
        limits.governed_by + (limits.contact.empty() ? "" : " of " + limits.contact);
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
  std::string left;
  if (outside.rock_kg() > 0) left = fmt::format("{:.4g} kg of rock", outside.rock_kg());
  if (outside.water_kg() > 0)
    left += fmt::format("{}{:.4g} kg of water", left.empty() ? "" : " and ", outside.water_kg());
  if (!left.empty()) m.warnings.push_back(left + " left through open faces of the domain");
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
  ExitBinRow row;
  row.exit = exit.name;
  row.bin = static_cast<int>(bin);
  row.from_m = f.from;
  row.to_m = f.to;
  row.from_s = exit.distribution.window.from;
  row.to_s = exit.distribution.window.to;
  if (parts.rocks) {
    row.rock_kg_s = limits(f.rock_kg_s);
    row.rock_speed_m_s = limits(f.rock_speed);
    row.rock_size_mean_m = limits(f.size_mean);
    row.rock_size_p80_m = limits(f.p80);
    row.rock_energy_W = limits(f.rock_power);
    row.rock_residence_s = limits(f.residence);
  }
  if (parts.water) {
    row.water_kg_s = limits(f.water_kg_s);
    row.fines_kg_s = limits(f.fines_kg_s);
    row.water_speed_m_s = limits(f.water_speed);
  }
  if (parts.rocks && parts.water) {
    row.water_m3_per_t = limits(f.m3_per_tonne);
    row.dry_rock_kg_s = limits(f.dry_rock_kg_s);
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
  const MassBudgets masses = mass_budgets(*parts.exits, parts.rocks.get(), parts.water.get());
  if (parts.rocks) {
    m.counts.rocks = static_cast<std::int64_t>(parts.rocks->rocks().count());
    m.counts.rocks_max = static_cast<std::int64_t>(simulation.rocks_max());
    m.budgets.rock = budget_entry(parts, masses.rock, parts.initial_rock_kg, &Inflow::rock);
    m.overlap = RunManifest::Overlap{parts.rocks->overlap_mean(), parts.rocks->overlaps().quantile(0.99),
                                     parts.rocks->overlap_max()};
    m.memory.rock_bytes = static_cast<std::int64_t>(parts.rocks->memory_bytes());
  }
  if (parts.water) {
    m.counts.water_points = static_cast<std::int64_t>(parts.water->count());
    m.counts.water_points_max = static_cast<std::int64_t>(simulation.points_max());
    m.budgets.water = budget_entry(parts, masses.water, parts.initial_water_kg, &Inflow::water);
    m.budgets.fines = budget_entry(parts, masses.fines, parts.initial_fines_kg, &Inflow::fines);
    m.memory.fluid_bytes = static_cast<std::int64_t>(parts.water->memory_bytes());
  }
  if (const ResolvedExtent* resolved = parts.coupling ? parts.coupling->resolved() : nullptr)
    m.resolved = RunManifest::Resolved{resolved->from, resolved->partly_from,
                                       static_cast<std::int64_t>(resolved->most_whole),
                                       static_cast<std::int64_t>(resolved->most_partly)};
  m.memory.peak_bytes = peak_bytes();
  m.budgets.momentum_residual_N_s = momentum_gap(parts);
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
      mixing.push_back({r.t, fmt::format("{} at {:.2f} m", mixer->name(), r.position), r.position, r.rock_kg,
                        r.water_kg, r.lacey, r.rsd, r.wetted});
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
    if (parts.coupling && !parts.coupling->film_loads().empty()) row.water += parts.coupling->film_loads()[w];
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
