#include "validation/extremes.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>

#include "analysis/budgets.h"
#include "base/errors.h"
#include "processes/build_parts.h"
#include "simulation/simulation.h"

namespace sluice {

namespace {

/// Where a rung of few particles is cut short.
constexpr std::uint64_t most_steps = 400'000;
/// Mass that may be missing, of all that came in: roundings of a sum.
constexpr double lost_mass = 1e-12;

double share_of(const std::string& text) {
  double number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// The step that is this share of the critical one, of the part whose step is the shorter.
TimeStep step_at(const Parts& parts, const ProcessConfig& config, double share) {
  TimeStep step = choose_time_step(parts);
  if (!parts.water) {
    step.dt = step.rock_substeps * share * parts.rocks->limits().network;
  } else {
    step.dt = step.fluid_substeps * share * parts.water->limits().acoustic / config.water->courant;
  }
  return step;
}

/// The share that a user gets.
double standard_share(const Parts& parts, const ProcessConfig& config) {
  if (!parts.water) return parts.rocks->limits().step / parts.rocks->limits().network;
  return parts.water->limits().step / (parts.water->limits().acoustic / config.water->courant);
}

/// The first quantity that is no number; "" if there is none.
std::string not_finite(const Parts& parts) {
  if (parts.rocks) {
    const Rocks& r = parts.rocks->rocks();
    for (std::size_t i = 0; i < r.count(); ++i)
      if (!r.x[i].allFinite() || !r.v[i].allFinite() || !r.w[i].allFinite() || !r.q[i].coeffs().allFinite())
        return fmt::format("rock {} is at no place", r.id[i]);
  }
  if (parts.water) {
    const WaterPoints p = parts.water->points();
    for (std::size_t i = 0; i < p.count(); ++i)
      if (!p.x[i].allFinite() || !p.v[i].allFinite() || !std::isfinite(p.pressure[i]))
        return fmt::format("point {} is at no place", p.id[i]);
  }
  return "";
}

/// Mass that is nowhere; "" if there is none.
std::string missing_mass(const Parts& parts) {
  MassBudgets b = mass_budgets(*parts.exits, parts.rocks.get(), parts.water.get());
  b.rock.initial = parts.initial_rock_kg;
  b.water.initial = parts.initial_water_kg;
  for (const auto& inflow : parts.inflows) {
    b.rock.entered += inflow->rock().entered;
    b.water.entered += inflow->water().entered;
  }
  for (const PhaseBudget* phase : {&b.rock, &b.water})
    if (std::abs(phase->lost()) > lost_mass * (phase->initial + phase->entered))
      return fmt::format("{:.3g} kg are missing", phase->lost());
  return "";
}

void run_to_end(double duration, double particle_steps, Simulation& simulation, ExtremeRung& out) {
  const Parts& parts = simulation.parts();
  const double dt = simulation.time_step().dt;
  const auto read = [&] {
    out.simulated = simulation.time();
    out.steps = static_cast<double>(simulation.steps());
    if (parts.rocks) {
      out.overlap = parts.rocks->overlap_max();
      out.created = 100 * simulation.watch().created_by_rocks();
    }
  };
  try {
    while (simulation.time() + 0.5 * dt < duration) {
      simulation.step();
      if (parts.water)
        out.mach = std::max(out.mach, parts.water->largest_speed() / parts.water->limits().sound_speed);
      if (simulation.rock_steps() + simulation.point_steps() > particle_steps ||
          simulation.steps() > most_steps) {
        out.message = fmt::format("cut short at {:.2g} of {:g} s", simulation.time(), duration);
        break;
      }
    }
    out.outcome = ExtremeOutcome::runs;
  } catch (const NumericalError& e) {
    out.outcome = ExtremeOutcome::stops;
    out.message = e.what();
  }
  read();
  if (out.outcome != ExtremeOutcome::runs) return;
  for (const std::string& problem : {not_finite(parts), missing_mass(parts)}) {
    if (problem.empty()) continue;
    out.outcome = ExtremeOutcome::broken;
    out.message = problem;
  }
}

std::vector<std::string> settings_of(const ExtremeConfig& config, const ExtremeSetting& setting) {
  std::vector<std::string> all = config.set;
  for (const std::string& key : config.vary)
    if (key != step_over_limit) all.push_back(key + "=" + setting.at);
  all.insert(all.end(), setting.with.begin(), setting.with.end());
  return all;
}

/// A message that names a file by its name alone: the page is read where its folder is not.
std::string without_folder(std::string message, const std::filesystem::path& file) {
  const std::string folder = file.parent_path().string() + "/";
  for (std::size_t at = message.find(folder); folder.size() > 1 && at != std::string::npos;
       at = message.find(folder, at))
    message.erase(at, folder.size());
  return message;
}

bool varies_step(const ExtremeConfig& config) {
  return std::find(config.vary.begin(), config.vary.end(), step_over_limit) != config.vary.end();
}

/// Whether a message quotes the key of "water.courant=0.1": with its path or without, alone or with a value.
bool names_key(const std::string& message, const std::string& setting) {
  const std::string path = setting.substr(0, setting.find('='));
  for (const std::string& key : {path, path.substr(path.rfind('.') + 1)})
    for (const char* end : {"'", ": "})
      if (message.find("'" + key + end) != std::string::npos) return true;
  return false;
}

void try_remedy(const ExtremeConfig& config, HardRun run, ExtremeRung& rung) {
  if (config.remedy.empty() || rung.outcome == ExtremeOutcome::runs || rung.outcome == ExtremeOutcome::broken)
    return;
  for (const std::string& setting : config.remedy) {
    run.overrides.push_back(setting);
    rung.remedy += (rung.remedy.empty() ? "" : ", ") + setting;
  }
  rung.remedy_named =
      std::any_of(config.remedy.begin(), config.remedy.end(),
                  [&](const std::string& setting) { return names_key(rung.message, setting); });
  // The remedy of a step that was too long on purpose is a shorter one: the default.
  run.step_share.reset();
  rung.remedy_works = run_hard(run).outcome == ExtremeOutcome::runs;
}

}  // namespace

ExtremeRung run_hard(const HardRun& run) {
  ExtremeRung out;
  const auto start = std::chrono::steady_clock::now();
  try {
    const ProcessConfig config = read_process(run.process, run.overrides);
    BuiltProcess built = build_parts(config);
    out.warnings = built.warnings;
    std::optional<TimeStep> step;
    if (run.step_share) step = step_at(built.parts, config, *run.step_share);
    Simulation simulation(std::move(built.parts), step);
    run_to_end(config.duration, run.particle_steps, simulation, out);
  } catch (const InputError& e) {
    out.outcome = ExtremeOutcome::refused;
    out.message = e.what();
  } catch (const NumericalError& e) {
    // while the scene was filled
    out.outcome = ExtremeOutcome::stops;
    out.message = e.what();
  } catch (const std::exception& e) {
    out.outcome = ExtremeOutcome::broken;
    out.message = e.what();
  }
  out.message = without_folder(std::move(out.message), run.process);
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

ExtremeCase run_extreme(const Extreme& what, const ExtremeOptions& options) {
  const ExtremeConfig& config = what.config;
  ExtremeCase out;
  out.name = what.name;
  out.title = config.title;
  out.group = config.group;
  out.expect = config.expect;
  out.scene = config.scene.filename().string();
  out.vary = fmt::format("{}", fmt::join(config.vary, ", "));
  out.default_words = config.standard;
  if (!config.standard.empty()) out.default_number = share_of(config.standard);
  if (varies_step(config)) {
    const ProcessConfig process = read_process(config.scene, config.set);
    out.default_number = standard_share(build_parts(process).parts, process);
    out.default_words = fmt::format("{:.3g}", *out.default_number);
  }
  for (const ExtremeSetting& setting : config.over) {
    if (options.quick && !setting.quick) continue;
    if (!options.only.empty() && setting.at != options.only) continue;
    HardRun run{config.scene, settings_of(config, setting), std::nullopt,
                options.quick ? quick_particle_steps : most_particle_steps};
    if (varies_step(config)) run.step_share = setting.number;
    ExtremeRung rung = run_hard(run);
    rung.setting = setting.at;
    rung.number = setting.number;
    rung.expected = setting.expect;
    rung.command = fmt::format("sluice validate --extremes {} --rung '{}'", what.name, setting.at);
    try_remedy(config, run, rung);
    out.rungs.push_back(std::move(rung));
    if (options.told) options.told(out, out.rungs.back());
  }
  if (!options.only.empty() && out.rungs.empty())
    throw InputError({{"--rung", 0, 0},
                      "rung",
                      fmt::format("'{}' is not a rung of {}", options.only, what.name),
                      "",
                      "see sluice validate --extremes --list"});
  return out;
}

}  // namespace sluice
