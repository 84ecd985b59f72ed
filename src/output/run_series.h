#pragma once
/// What `sluice converge` and `sluice study` have to say: converge.json and .csv, study.json and .csv.
/// Keys and columns are added, never renamed; SI units; a number that is not known is null or an empty cell.
///
/// converge.csv, one row per result and rung:
///   result, rung (as given), setting (SI; empty where it is a word), outcome, value, low95, high95,
///   steady (1 or 0), reason, run_time_s, change (from the rung before), change_low95, change_high95,
///   verdict (resolved, changed, bounded, too_short, unknown; see analysis/convergence.h)
/// study.csv, one row per result, variation and seed; seed "all" is the mean over seeds with its limits:
///   result, variation, seed, outcome, value, low95, high95, steady, reason, run_time_s

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/claim.h"
#include "analysis/convergence.h"
#include "output/csv.h"
#include "output/key_results.h"

namespace sluice {

/// One run of the series.
struct SeriesRow {
  std::string label;         ///< of the rung or variation
  double setting = 0;        ///< of a rung, SI; NaN where it is a word
  std::optional<long> seed;  ///< of a study's run
  std::filesystem::path folder;
  std::string command;  ///< that makes this run alone
  std::string outcome;  ///< as in run.json; "failed" where it has none
  std::string message;  ///< of a failure
  std::string commit, state_hash;
  double run_time = 0, simulated = 0;           ///< [s]
  std::optional<double> rock_step, water_step;  ///< [s]
  std::optional<double> rocks, water_points;    ///< at most
  double memory = 0;                            ///< [bytes]
  std::vector<KeyResult> results;

  bool completed() const { return outcome == "completed"; }
};

/// Reads a run folder; one without run.json is a run that failed before its first step.
SeriesRow read_series_row(const std::filesystem::path& folder);

struct SeriesProvenance {
  std::string version, commit, compiler, flags, cpu, command;
  int threads = 0;
};

struct ConvergeRecord {
  SeriesProvenance made_by;
  std::string process, title, vary;
  std::vector<std::string> notes;  ///< what weakens the comparison
  std::vector<SeriesRow> rungs;    ///< coarse to fine, as given

  LadderPoint point(std::size_t rung, const std::string& result) const;
  /// From the rung before; none for the first.
  std::optional<Change> change(std::size_t rung, const std::string& result) const;
  std::optional<Extrapolation> extrapolation(const std::string& result) const;
  /// Every result that a completed rung has, in order, as the last of these has it.
  std::vector<KeyResult> results() const;
};

CsvTable converge_table(const ConvergeRecord& record);
std::string converge_json(const ConvergeRecord& record);

struct StudyClaim {
  std::string text, result, first, other;
  ClaimKind kind = ClaimKind::lower;
  double margin = 0;
  ClaimResult outcome;
};

struct StudyRecord {
  SeriesProvenance made_by;
  std::string file, title;
  std::vector<std::string> notes;
  std::vector<std::string> variations;
  std::vector<SeriesRow> runs;
  std::vector<StudyClaim> claims;

  /// Values of one result by seed; NaN where a run has none.
  std::vector<double> values(const std::string& variation, const std::string& result) const;
  /// Over the seeds; of a single run its own limits.
  Estimate estimate(const std::string& variation, const std::string& result) const;
  std::vector<KeyResult> results() const;  ///< every result, as the last run has it
};

CsvTable study_table(const StudyRecord& record);
std::string study_json(const StudyRecord& record);

}  // namespace sluice
