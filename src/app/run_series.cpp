#include "app/run_series.h"

#include <fmt/format.h>

#include <cmath>

#include "app/process_source.h"
#include "output/checkpoint.h"
#include "output/run_manifest.h"
#include "processes/build_parts.h"
#include "sluice_version.h"

namespace sluice {

namespace {

std::string quoted(const std::string& word) {
  const bool plain =
      word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-/=") ==
      std::string::npos;
  return plain && !word.empty() ? word : "'" + word + "'";
}

/// The same problems, those of an override placed where the series makes it.
InputError placed(const InputError& error, const PlannedRun& run) {
  std::vector<InputProblem> problems = error.problems();
  for (InputProblem& p : problems)
    if (p.where.file.starts_with("--set")) p.where = run.place;
  return InputError(std::move(problems));
}

ProcessSource source_of(const PlannedRun& run) {
  try {
    return read_process_source(run.options.process, run.options.overrides);
  } catch (const InputError& error) {
    throw placed(error, run);
  }
}

}  // namespace

std::string folder_name(const std::string& setting) {
  std::string name;
  for (const char c : setting) {
    const bool keep = std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '_' || c == '-';
    if (keep)
      name += c;
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  while (name.ends_with('-')) name.pop_back();
  return name.empty() || name.find_first_not_of('.') == std::string::npos ? "setting" : name;
}

std::string command_of(const RunOptions& options) {
  std::string line = "sluice run " + quoted(options.process.string());
  for (const std::string& set : options.overrides) line += " --set " + quoted(set);
  if (!options.until.empty()) line += " --until " + quoted(options.until);
  if (options.whole) line += " --no-stop";
  return line + " --out " + quoted(options.out.string());
}

Standing standing_of(const PlannedRun& run) {
  const RunFolder folder{run.options.out};
  if (!std::filesystem::exists(folder.manifest())) return Standing::fresh;
  const RunManifest m = read_manifest(folder.manifest());
  const ProcessSource source = source_of(run);
  if (m.process.sha256 != source.sha256)
    throw InputError(InputProblem{{folder.root.string(), 0, 0},
                                  "",
                                  fmt::format("holds another run than '{}'", run.name),
                                  "the process or what is set has changed since",
                                  "give another --out, or remove the folder"});
  const double end = end_of_run(source.config, run.options.until);
  const double step = std::max(m.time.dt_fluid_s.value_or(0), m.time.dt_rock_s.value_or(0));
  if (m.outcome == Outcome::completed && m.time.simulated_s + step >= end) return Standing::finished;
  // The program has changed: it may come through now.
  if (m.outcome == Outcome::failed)
    return m.sluice.commit == program_commit ? Standing::failed : Standing::fresh;
  return find_checkpoint(folder) ? Standing::unfinished : Standing::fresh;
}

void check_series(const std::vector<PlannedRun>& runs) {
  for (const PlannedRun& run : runs) {
    end_of_run(source_of(run).config, run.options.until);
    if (standing_of(run) == Standing::finished) continue;
    try {
      build_parts(read_process(run.options.process, run.options.overrides));
    } catch (const InputError& error) {
      throw placed(error, run);
    } catch (const NumericalError&) {
      // It will be a row that says so.
    }
  }
}

int run_series(const std::vector<PlannedRun>& runs, const RunOne& run_one) {
  bool failed = false;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const PlannedRun& run = runs[k];
    const Standing standing = standing_of(run);
    const char* words = standing == Standing::finished     ? "finished before"
                        : standing == Standing::failed     ? "failed before"
                        : standing == Standing::unfinished ? "goes on"
                                                           : "starts";
    fmt::print("\n[{}/{}] {}: {}\n", k + 1, runs.size(), run.name, words);
    std::fflush(stdout);
    failed = failed || standing == Standing::failed;
    if (standing == Standing::finished || standing == Standing::failed) continue;
    RunOptions options = run.options;
    options.resume = standing == Standing::unfinished;
    const int code = run_one(options);
    if (code == 130) return 130;
    if (code == 3) failed = true;
    if (code != 0 && code != 3)
      throw EnvironmentError(
          fmt::format("'{}' ended with exit code {}; what is finished is kept: give the same "
                      "command again once the cause is removed",
                      run.name, code));
  }
  return failed ? 3 : 0;
}

}  // namespace sluice
