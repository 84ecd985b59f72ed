#include <fmt/format.h>

#include <cmath>

#include "app/run_series.h"
#include "app/series_provenance.h"
#include "base/units.h"
#include "output/run_series.h"
#include "processes/find_key.h"
#include "processes/process_config.h"
#include "reports/converge_page.h"

namespace sluice {

namespace {

Location vary_place() {
  return {"--vary", 0, 0};
}
Location over_place() {
  return {"--over", 0, 0};
}

/// Cut at commas that stand in no bracket and no quotes, blanks trimmed.
std::vector<std::string> settings_of(const std::string& over) {
  std::vector<std::string> settings(1);
  int depth = 0;
  char quote = 0;
  for (const char c : over) {
    if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '\'' || c == '"') {
      quote = c;
    } else {
      depth += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
    }
    if (c == ',' && depth == 0 && !quote)
      settings.emplace_back();
    else
      settings.back() += c;
  }
  for (std::string& s : settings) {
    const std::size_t first = s.find_first_not_of(" \t");
    s = first == std::string::npos ? "" : s.substr(first, s.find_last_not_of(" \t") - first + 1);
  }
  return settings;
}

/// SI value of a setting; NaN for a word.
double number_of(const KeyEntry& key, const std::string& setting) {
  const bool plain = key.type == KeyEntry::Type::number || key.type == KeyEntry::Type::integer;
  return plain ? read_quantity(setting, key.unit).value.value_or(std::nan("")) : std::nan("");
}

std::vector<PlannedRun> plan(const ConvergeOptions& options, const std::filesystem::path& out,
                             const std::vector<std::string>& settings) {
  std::vector<PlannedRun> runs;
  for (const std::string& setting : settings) {
    PlannedRun run;
    run.name = options.vary + " = " + setting;
    run.place = over_place();
    run.options.process = options.process;
    run.options.out = out / folder_name(setting);
    run.options.threads = options.threads;
    run.options.until = options.until;
    run.options.whole = true;
    run.options.overrides = options.overrides;
    run.options.overrides.push_back(options.vary + "=" + setting);
    runs.push_back(std::move(run));
  }
  return runs;
}

void check_settings(const std::vector<std::string>& settings, const std::vector<double>& numbers) {
  if (settings.size() < 2)
    throw InputError(InputProblem{over_place(), "", fmt::format("has {} setting", settings.size()),
                                  "a ladder has two rungs at least", "write --over '40 mm, 20 mm, 10 mm'"});
  for (std::size_t k = 0; k < settings.size(); ++k) {
    if (settings[k].empty())
      throw InputError(
          InputProblem{over_place(), "", "has an empty setting", "", "write --over '40 mm, 20 mm'"});
    for (std::size_t i = 0; i < k; ++i)
      if (folder_name(settings[i]) == folder_name(settings[k]) || numbers[i] == numbers[k])
        throw InputError(InputProblem{over_place(), "",
                                      fmt::format("has '{}' and '{}'", settings[i], settings[k]),
                                      "two rungs would be alike", "leave one of them out"});
  }
}

/// What weakens the comparison, in words.
std::vector<std::string> notes_of(const ConvergeOptions& options, const ProcessConfig& config,
                                  const ConvergeRecord& record) {
  std::vector<std::string> notes;
  const std::string section = options.vary.substr(0, options.vary.find('.'));
  if (section == "seed" || section == "conveyors" || section == "rock_fills")
    notes.push_back(
        fmt::format("'{}' changes what is fed: the rungs do not share one sequence of rocks, and their "
                    "differences hold that too",
                    options.vary));
  if (config.stop)
    notes.push_back("every rung runs to the same time: 'stop', which would end each at its own, is left out");
  for (const SeriesRow& row : record.rungs)
    if (!row.commit.empty() && row.commit != record.rungs.front().commit)
      notes.push_back(fmt::format("'{}' was made by another build ({}) than '{}' ({})", row.label, row.commit,
                                  record.rungs.front().label, record.rungs.front().commit));
  return notes;
}

std::string command_line(const ConvergeOptions& o) {
  std::string line =
      fmt::format("sluice converge {} --vary {} --over '{}'", o.process.string(), o.vary, o.over);
  for (const std::string& set : o.overrides) line += " --set '" + set + "'";
  if (!o.until.empty()) line += " --until '" + o.until + "'";
  return line;
}

std::filesystem::path out_folder(const ConvergeOptions& options) {
  if (!options.out.empty()) return options.out;
  const std::string key = options.vary.substr(options.vary.rfind('.') + 1);
  return std::filesystem::path("out") / (options.process.stem().string() + "-" + folder_name(key));
}

}  // namespace

int converge_process(const ConvergeOptions& options) {
  const std::vector<KeyEntry> keys = process_keys<ProcessConfig>();
  ProcessDocument document = ProcessDocument::read(options.process, options.overrides);
  const ProcessConfig config = document.as<ProcessConfig>();
  document.finish();
  if (auto problems = misnamed_key(document, keys, options.vary, vary_place()); !problems.empty())
    throw InputError(std::move(problems));
  const KeyEntry& key = *find_key(keys, options.vary);
  const std::vector<std::string> settings = settings_of(options.over);
  std::vector<double> numbers;
  for (const std::string& setting : settings) numbers.push_back(number_of(key, setting));
  check_settings(settings, numbers);

  const std::filesystem::path out = out_folder(options);
  const std::vector<PlannedRun> runs = plan(options, out, settings);
  check_series(runs);
  const int code = run_series(runs, run_apart);
  if (code == 130) {
    fmt::print(stderr, "interrupted; the same command goes on from here\n");
    return code;
  }

  ConvergeRecord record;
  record.made_by = series_provenance(command_line(options), options.threads);
  record.process = options.process.string();
  record.title = config.title;
  record.vary = options.vary;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    SeriesRow row = read_series_row(runs[k].options.out);
    row.label = settings[k];
    row.setting = numbers[k];
    row.command = command_of(runs[k].options);
    record.rungs.push_back(std::move(row));
  }
  record.notes = notes_of(options, config, record);
  write_converge_page(out, record);
  fmt::print("\n{}\npage: {}\n", converge_text(record), (out / "converge.html").string());
  return code;
}

}  // namespace sluice
