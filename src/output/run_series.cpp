#include "output/run_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "output/run_manifest.h"

namespace sluice {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

std::string word_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::running:
      return "running";
    case Outcome::completed:
      return "completed";
    case Outcome::interrupted:
      return "interrupted";
    case Outcome::failed:
      return "failed";
  }
  return "";
}

std::optional<double> as_number(std::optional<std::int64_t> n) {
  return n ? std::optional<double>(static_cast<double>(*n)) : std::nullopt;
}

std::vector<KeyResult> all_results(const std::vector<SeriesRow>& rows) {
  std::vector<KeyResult> all;
  for (const SeriesRow& row : rows) {
    if (!row.completed()) continue;
    for (const KeyResult& r : row.results) {
      const auto same = std::find_if(all.begin(), all.end(), [&](const auto& a) { return a.name == r.name; });
      if (same == all.end())
        all.push_back(r);
      else
        *same = r;
    }
  }
  return all;
}

}  // namespace

SeriesRow read_series_row(const std::filesystem::path& root) {
  SeriesRow row;
  row.folder = root;
  row.setting = not_known;
  const RunFolder folder{root};
  if (!std::filesystem::exists(folder.manifest())) {
    row.outcome = "failed";
    row.message = "it stopped before its first step; see the message above the table";
    return row;
  }
  const RunManifest m = read_manifest(folder.manifest());
  row.outcome = word_of(m.outcome);
  if (m.failure) row.message = m.failure->message;
  row.commit = m.sluice.commit;
  row.state_hash = m.state_hash;
  row.run_time = m.time.wall_s;
  row.simulated = m.time.simulated_s;
  row.rock_step = m.time.dt_rock_s;
  row.water_step = m.time.dt_fluid_s;
  row.rocks = as_number(m.counts.rocks_max);
  row.water_points = as_number(m.counts.water_points_max);
  row.memory = static_cast<double>(m.memory.peak_bytes);
  row.results = key_results(folder);
  return row;
}

LadderPoint ConvergeRecord::point(std::size_t rung, const std::string& result) const {
  const SeriesRow& row = rungs[rung];
  const KeyResult* r = row.completed() ? find_result(row.results, result) : nullptr;
  if (!r) return {row.setting, not_known, not_known};
  // Limits of a flow that is not steady say nothing about its mean.
  return {row.setting, r->value, r->steady ? r->half_width : not_known};
}

std::optional<Change> ConvergeRecord::change(std::size_t rung, const std::string& result) const {
  if (rung == 0) return std::nullopt;
  return change_between(point(rung - 1, result), point(rung, result));
}

std::optional<Extrapolation> ConvergeRecord::extrapolation(const std::string& result) const {
  std::vector<LadderPoint> points;
  for (std::size_t k = 0; k < rungs.size(); ++k) points.push_back(point(k, result));
  return extrapolate(points);
}

std::vector<KeyResult> ConvergeRecord::results() const {
  return all_results(rungs);
}

CsvTable converge_table(const ConvergeRecord& record) {
  CsvTable table;
  table.columns = {"result", "rung",   "setting",    "outcome", "value",        "low95",         "high95",
                   "steady", "reason", "run_time_s", "change",  "change_low95", "change_high95", "verdict"};
  for (const KeyResult& result : record.results())
    for (std::size_t k = 0; k < record.rungs.size(); ++k) {
      const SeriesRow& row = record.rungs[k];
      const KeyResult* r = row.completed() ? find_result(row.results, result.name) : nullptr;
      const double value = r ? r->value : not_known, half = r ? r->half_width : not_known;
      const std::optional<Change> c = record.change(k, result.name);
      const double change = c ? c->value : not_known, spread = c ? c->half_width : not_known;
      table.add({result.name, row.label, row.setting, row.outcome, value, value - half, value + half,
                 r && r->steady ? 1.0 : 0.0, r ? r->reason : row.message, row.run_time, change,
                 change - spread, change + spread, c ? word_of(c->verdict) : ""});
    }
  return table;
}

std::vector<double> StudyRecord::values(const std::string& variation, const std::string& result) const {
  std::vector<double> out;
  for (const SeriesRow& run : runs) {
    if (run.label != variation) continue;
    const KeyResult* r = run.completed() ? find_result(run.results, result) : nullptr;
    out.push_back(r ? r->value : not_known);
  }
  return out;
}

Estimate StudyRecord::estimate(const std::string& variation, const std::string& result) const {
  std::vector<double> known;
  for (const double v : values(variation, result))
    if (std::isfinite(v)) known.push_back(v);
  Estimate e = replicate_mean(known);
  if (known.size() > 1) return e;
  for (const SeriesRow& run : runs) {
    const KeyResult* r =
        run.label == variation && run.completed() ? find_result(run.results, result) : nullptr;
    if (r) e = {r->value, r->steady ? r->half_width : not_known};
  }
  return e;
}

std::vector<KeyResult> StudyRecord::results() const {
  return all_results(runs);
}

CsvTable study_table(const StudyRecord& record) {
  CsvTable table;
  table.columns = {"result", "variation", "seed",   "outcome", "value",
                   "low95",  "high95",    "steady", "reason",  "run_time_s"};
  for (const KeyResult& result : record.results())
    for (const std::string& variation : record.variations) {
      double seconds = 0;
      for (const SeriesRow& row : record.runs) {
        if (row.label != variation) continue;
        seconds += row.run_time;
        const KeyResult* r = row.completed() ? find_result(row.results, result.name) : nullptr;
        const double value = r ? r->value : not_known, half = r ? r->half_width : not_known;
        table.add({result.name, variation, row.seed ? CsvCell(static_cast<double>(*row.seed)) : CsvCell(""),
                   row.outcome, value, value - half, value + half, r && r->steady ? 1.0 : 0.0,
                   r ? r->reason : row.message, row.run_time});
      }
      const Estimate e = record.estimate(variation, result.name);
      table.add({result.name, variation, "all", "", e.value, e.value - e.half_width, e.value + e.half_width,
                 not_known, "", seconds});
    }
  return table;
}

}  // namespace sluice
