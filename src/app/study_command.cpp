#include <fmt/format.h>

#include <algorithm>

#include "app/run_series.h"
#include "app/series_provenance.h"
#include "output/run_series.h"
#include "processes/input_node.h"
#include "processes/study_config.h"
#include "reports/study_page.h"

namespace sluice {

namespace {

/// Seeds to run; one that stands for "the process's own" where the study has none.
std::vector<std::optional<long>> seeds_of(const StudyConfig& study) {
  if (study.seeds.empty()) return {std::nullopt};
  std::vector<std::optional<long>> seeds;
  for (const double seed : study.seeds) seeds.emplace_back(static_cast<long>(seed));
  return seeds;
}

struct Plan {
  std::vector<PlannedRun> runs;
  std::vector<std::string> labels;
  std::vector<std::optional<long>> seeds;
};

/// A seed that is set would be overridden by those of the study.
void refuse_set_seed(const StudyOptions& options, const StudyConfig& study) {
  if (study.seeds.empty()) return;
  const auto check = [](const std::vector<std::string>& set, const Location& where) {
    for (const std::string& assignment : set)
      if (assignment.starts_with("seed="))
        throw InputError(
            InputProblem{where, "seed", "is set", "the study has 'seeds'", "leave one of them out"});
  };
  check(study.set, study.set_at);
  for (const VariationConfig& v : study.variations) check(v.set, v.set_at);
  check(options.overrides, {"--set", 0, 0});
}

/// All variations with the first seed, then with the next: an interrupted study is a smaller one.
Plan plan(const StudyOptions& options, const StudyConfig& study, const std::filesystem::path& out) {
  Plan plan;
  for (const std::optional<long>& seed : seeds_of(study))
    for (const VariationConfig& variation : study.variations) {
      PlannedRun run;
      run.name = variation.name + (seed ? fmt::format(", seed {}", *seed) : "");
      run.place = variation.set_at;
      run.options.process = std::filesystem::proximate(study.process_of(variation));
      run.options.out = out / (folder_name(variation.name) + (seed ? fmt::format("-{}", *seed) : ""));
      run.options.threads = options.threads;
      run.options.until = options.until.empty() ? study.until : options.until;
      run.options.whole = true;
      run.options.overrides = study.set;
      run.options.overrides.insert(run.options.overrides.end(), variation.set.begin(), variation.set.end());
      run.options.overrides.insert(run.options.overrides.end(), options.overrides.begin(),
                                   options.overrides.end());
      if (seed) run.options.overrides.push_back(fmt::format("seed={}", *seed));
      plan.runs.push_back(std::move(run));
      plan.labels.push_back(variation.name);
      plan.seeds.push_back(seed);
    }
  return plan;
}

void judge(StudyRecord& record, const StudyConfig& study) {
  for (const ClaimConfig& config : study.claims) {
    StudyClaim claim;
    claim.text = config.text;
    claim.result = config.result;
    claim.first = config.of;
    claim.other = config.against;
    claim.kind = config.kind == ClaimConfig::Kind::lower ? ClaimKind::lower : ClaimKind::alike;
    claim.margin = config.margin;
    claim.outcome = judge_claim(claim.kind, record.values(config.of, config.result),
                                record.values(config.against, config.result), config.margin);
    record.claims.push_back(std::move(claim));
  }
}

/// A result that no run has is a misspelt one.
void check_claims(const StudyRecord& record, const StudyConfig& study) {
  std::vector<std::string> names;
  for (const KeyResult& r : record.results()) names.push_back(r.name);
  if (names.empty()) return;
  std::vector<InputProblem> problems;
  for (const ClaimConfig& claim : study.claims)
    if (std::find(names.begin(), names.end(), claim.result) == names.end())
      problems.push_back({claim.where, "result", fmt::format("is '{}'", claim.result),
                          "no run has a result of that name; study.csv names them all",
                          suggest_word(claim.result, names)});
  if (!problems.empty()) throw InputError(std::move(problems));
}

std::vector<std::string> notes_of(const StudyRecord& record) {
  std::vector<std::string> notes;
  for (const SeriesRow& row : record.runs)
    if (!row.commit.empty() && row.commit != record.runs.front().commit) {
      notes.emplace_back("the runs were made by different builds; the table of runs has their states");
      break;
    }
  bool steady = true;
  for (const SeriesRow& row : record.runs)
    for (const KeyResult& r : row.results) steady = steady && (r.steady || !r.headline);
  if (!steady)
    notes.emplace_back(
        "not every run reached a steady state: averages are then over the second half of the run, the same "
        "time in "
        "all of them, and speak for that time after the start, not for continuous operation");
  return notes;
}

}  // namespace

int run_study(const StudyOptions& options) {
  const StudyConfig study = read_study(options.study);
  refuse_set_seed(options, study);
  const std::filesystem::path out =
      options.out.empty() ? std::filesystem::path("out") / options.study.stem() : options.out;
  const Plan planned = plan(options, study, out);
  check_series(planned.runs);
  const int code = run_series(planned.runs, run_apart);
  if (code == 130) {
    fmt::print(stderr, "interrupted; the same command goes on from here\n");
    return code;
  }

  StudyRecord record;
  std::string command = "sluice study " + options.study.string();
  if (!options.until.empty()) command += " --until '" + options.until + "'";
  for (const std::string& set : options.overrides) command += " --set '" + set + "'";
  record.made_by = series_provenance(std::move(command), options.threads);
  record.file = options.study.string();
  record.title = study.title;
  for (const VariationConfig& variation : study.variations) record.variations.push_back(variation.name);
  for (std::size_t k = 0; k < planned.runs.size(); ++k) {
    SeriesRow row = read_series_row(planned.runs[k].options.out);
    row.label = planned.labels[k];
    row.seed = planned.seeds[k];
    row.command = command_of(planned.runs[k].options);
    record.runs.push_back(std::move(row));
  }
  record.notes = notes_of(record);
  judge(record, study);
  write_study_page(out, record);
  fmt::print("\n{}\npage: {}\n", study_text(record), (out / "study.html").string());
  check_claims(record, study);
  return code;
}

}  // namespace sluice
