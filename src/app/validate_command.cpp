#include <fmt/format.h>

#include <algorithm>

#include "app/commands.h"
#include "app/summary.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "processes/input_node.h"
#include "reports/validation_page.h"
#include "sluice_version.h"
#include "validation/kept_cases.h"
#include "validation/ladder.h"

namespace sluice {

namespace {

/// The cases asked for, in that order; all of them where none is.
std::vector<Case> asked_cases(const ValidateOptions& options) {
  const std::vector<std::filesystem::path> folders = case_folders(options.cases);
  std::vector<std::string> names;
  for (const auto& folder : folders) names.push_back(folder.filename().string());
  std::vector<Case> cases;
  if (options.names.empty())
    for (const auto& folder : folders) cases.push_back(read_case(folder));
  for (const std::string& name : options.names) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError({{"sluice validate", 0, 0},
                        name,
                        "is not a case",
                        fmt::format("no {}/{}/case.yaml", options.cases.string(), name),
                        suggest_word(name, names)});
    cases.push_back(read_case(options.cases / name));
  }
  return cases;
}

void list_cases(const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    std::string rungs;
    for (const Rung& rung : c.config.ladder.rungs) rungs += (rungs.empty() ? "" : ", ") + rung.at;
    fmt::print("{:<26} {:<9} {} ({}: {})\n", c.name, c.config.group, c.config.title, c.config.ladder.vary,
               rungs);
  }
}

std::string command_line(const ValidateOptions& options) {
  std::string line = "sluice validate";
  for (const std::string& name : options.names) line += " " + name;
  if (options.quick) line += " --quick";
  if (options.update) line += " --update";
  if (!options.rung.empty()) line += " --rung '" + options.rung + "'";
  for (const std::string& key : options.scene_keys) line += " --set '" + key + "'";
  return line + fmt::format(" --threads {}", thread_count());
}

/// The record of all cases replaces the committed one or renews a part of it; any other part goes beside
/// other output.
std::filesystem::path out_folder(const ValidateOptions& options) {
  if (!options.out.empty()) return options.out;
  const bool everything =
      options.names.empty() && !options.quick && options.rung.empty() && options.scene_keys.empty();
  return everything || options.update ? "reports" : "out/validation";
}

/// Puts a case where it stands in the order of names.
void put(ValidationRecord& record, ValidationCase one) {
  const auto at = std::find_if(record.cases.begin(), record.cases.end(),
                               [&](const ValidationCase& c) { return c.name >= one.name; });
  if (at != record.cases.end() && at->name == one.name)
    *at = std::move(one);
  else
    record.cases.insert(at, std::move(one));
}

}  // namespace

int validate_cases(const ValidateOptions& options) {
  if (options.threads > 0) set_thread_count(options.threads);
  if ((!options.rung.empty() || !options.scene_keys.empty()) && options.names.size() != 1)
    throw InputError({{"sluice validate", 0, 0}, "", "--rung and --set need one case", "", "name it"});
  if (options.update && (options.quick || !options.rung.empty() || !options.scene_keys.empty()))
    throw InputError({{"sluice validate", 0, 0},
                      "",
                      "--update takes no --quick, --rung or --set",
                      "a record holds whole ladders of the cases as they are",
                      "leave one out"});
  const std::vector<Case> cases = asked_cases(options);
  if (options.list) {
    list_cases(cases);
    return 0;
  }

  const std::filesystem::path folder = out_folder(options);
  ValidationRecord record;
  if (options.update) record.cases = kept_cases(folder / "validation.json", case_folders(options.cases));
  record.made_by = {program_version, program_commit,   program_compiler,
                    program_flags,   processor_name(), thread_count()};
  record.command = command_line(options);
  LadderOptions ladder;
  ladder.extent = options.quick ? LadderExtent::quick : LadderExtent::whole;
  ladder.only = options.rung;
  ladder.scene_keys = options.scene_keys;
  ladder.told = [](const ValidationCase& c, const ValidationRung& r) {
    fmt::print("{:<26} {} = {:<10} error {:.3g}{}  {:.2f} s  {}\n", c.name, c.vary, r.setting, r.error,
               r.gate ? fmt::format(" (gate {:g})", *r.gate) : "", r.seconds,
               !r.stable ? "unstable: " + r.message : (r.passed() ? "" : "FAIL ") + r.message);
    std::fflush(stdout);
  };
  std::vector<ValidationCase> failed;
  std::size_t run = 0;
  for (const Case& c : cases) {
    if (options.quick && c.config.ladder.quick == 0) continue;
    ValidationCase one = run_ladder(c, ladder);
    one.made_by = record.made_by;
    if (!one.passed()) failed.push_back(one);
    ++run;
    put(record, std::move(one));
    write_validation_page(folder, record);  // what is done stays, whatever becomes of the rest
  }
  fmt::print("page: {}\n", (folder / "validation.html").string());
  for (const ValidationCase& c : failed) {
    const bool order = c.whole() && c.least_order && !(c.order && *c.order >= *c.least_order);
    fmt::print(stderr, "{}: a gate failed{}{}\n", c.name,
               order ? fmt::format(" (observed order {}, at least {} asked)",
                                   c.order ? fmt::format("{:.2g}", *c.order) : "unknown", *c.least_order)
                     : "",
               c.shortfall.empty() ? "" : ", a known shortfall: " + c.shortfall);
  }
  fmt::print("{} of {} cases passed\n", run - failed.size(), run);
  return failed.empty() ? 0 : gate_failed;
}

}  // namespace sluice
