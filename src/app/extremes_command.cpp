#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "app/commands.h"
#include "app/summary.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "processes/input_node.h"
#include "reports/extremes_page.h"
#include "sluice_version.h"
#include "validation/extremes.h"

namespace sluice {

namespace {

/// The cases asked for, in that order; all of them where none is.
std::vector<Extreme> asked_extremes(const ValidateOptions& options) {
  const std::filesystem::path root = options.cases / "extremes";
  std::vector<std::string> names;
  for (const auto& file : extreme_files(root)) names.push_back(file.stem().string());
  std::vector<Extreme> asked;
  for (const std::string& name : options.names.empty() ? names : options.names) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError({{"sluice validate --extremes", 0, 0},
                        name,
                        "is not an extreme case",
                        fmt::format("no {}/{}.yaml", root.string(), name),
                        suggest_word(name, names)});
    asked.push_back(read_extreme(root / (name + ".yaml")));
  }
  return asked;
}

void list_extremes(const std::vector<Extreme>& cases) {
  for (const Extreme& c : cases) {
    std::string rungs;
    for (const ExtremeSetting& rung : c.config.over) rungs += (rungs.empty() ? "" : ", ") + rung.at;
    fmt::print("{:<22} {:<9} {} ({}: {})\n", c.name, c.config.group, c.config.title,
               fmt::join(c.config.vary, ", "), rungs);
  }
}

std::string command_line(const ValidateOptions& options) {
  std::string line = "sluice validate --extremes";
  for (const std::string& name : options.names) line += " " + name;
  if (options.quick) line += " --quick";
  if (!options.rung.empty()) line += " --rung '" + options.rung + "'";
  return line + fmt::format(" --threads {}", thread_count());
}

void tell(const ExtremeCase& c, const ExtremeRung& r) {
  std::string remedy;
  if (!r.remedy.empty())
    remedy = fmt::format(" [{}: {}{}]", r.remedy, r.remedy_works ? "works" : "DOES NOT WORK",
                         r.remedy_named ? "" : ", NOT NAMED");
  fmt::print("{:<22} {:<32} {}{} {:.2f} s  {}{}\n", c.name, r.setting, outcome_word(r.outcome),
             r.outcome == r.expected ? "" : fmt::format(" (EXPECTED: {})", outcome_word(r.expected)),
             r.seconds, r.message, remedy);
  std::fflush(stdout);
}

}  // namespace

int validate_extremes(const ValidateOptions& options) {
  if (options.threads > 0) set_thread_count(options.threads);
  if (!options.scene_keys.empty())
    throw InputError({{"sluice validate --extremes", 0, 0},
                      "--set",
                      "does not go with --extremes",
                      "a rung has its settings in its case",
                      "edit the case, or run its scene with `sluice run`"});
  if (!options.rung.empty() && options.names.size() != 1)
    throw InputError({{"sluice validate", 0, 0}, "", "--rung needs one case", "", "name it"});
  const std::vector<Extreme> cases = asked_extremes(options);
  if (options.list) {
    list_extremes(cases);
    return 0;
  }
  ExtremesRecord record;
  record.version = program_version;
  record.commit = program_commit;
  record.compiler = program_compiler;
  record.flags = program_flags;
  record.cpu = processor_name();
  record.threads = thread_count();
  record.command = command_line(options);
  const auto start = std::chrono::steady_clock::now();
  for (const Extreme& c : cases) {
    ExtremeCase ran = run_extreme(c, {options.quick, options.rung, tell});
    if (!ran.rungs.empty()) record.cases.push_back(std::move(ran));
  }
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  // The record of all cases replaces the committed one; any part of it goes beside other output.
  const bool everything = options.names.empty() && !options.quick;
  const std::filesystem::path folder = !options.out.empty() ? options.out
                                       : everything         ? "reports"
                                                            : "out/validation";
  write_extremes_page(folder, record);
  fmt::print("page: {}\n", (folder / "extremes.html").string());
  std::size_t rungs = 0, bad = 0;
  for (const ExtremeCase& c : record.cases)
    for (const ExtremeRung& r : c.rungs) {
      ++rungs;
      if (!r.good()) ++bad;
    }
  fmt::print("{} of {} rungs as expected\n", rungs - bad, rungs);
  return bad > 0 ? gate_failed : 0;
}

}  // namespace sluice
