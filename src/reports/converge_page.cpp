#include "reports/converge_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/run_folder.h"
#include "reports/format.h"
#include "reports/log_chart.h"
#include "reports/page_shell.h"
#include "reports/series_sections.h"
#include "reports/series_words.h"

namespace sluice {

namespace {

std::string verdict_mark(const ConvergeRecord& record, std::size_t rung, const KeyResult& result) {
  if (rung == 0) return "";
  switch (record.change(rung, result.name)->verdict) {
    case ChangeVerdict::resolved:
      return "resolved";
    case ChangeVerdict::changed:
      return "changed";
    case ChangeVerdict::bounded:
      return "no change";
    case ChangeVerdict::too_short:
      return "too short";
    case ChangeVerdict::unknown:
      return "not known";
  }
  return "";
}

/// One cell: the value with its limits, and whether it differs from the rung before.
std::string cell(const ConvergeRecord& record, std::size_t rung, const KeyResult& result) {
  const LadderPoint p = record.point(rung, result.name);
  KeyResult plain = result;
  plain.shown_unit.clear();
  return shown(plain, p.value, p.half_width);
}

std::string what_of(const KeyResult& result) {
  return result.shown_unit.empty() ? result.what : result.what + ", " + result.shown_unit;
}

std::string result_table(const ConvergeRecord& record, const std::vector<KeyResult>& results) {
  std::vector<std::string> head = {html(record.vary)};
  for (const SeriesRow& row : record.rungs) head.push_back(html(row.label));
  std::vector<std::vector<std::string>> rows;
  for (const KeyResult& result : results) {
    std::vector<std::string> cells = {html(what_of(result))};
    for (std::size_t k = 0; k < record.rungs.size(); ++k) {
      const std::string mark = verdict_mark(record, k, result);
      cells.push_back(cell(record, k, result) +
                      (mark.empty() ? "" : "<br><small class=\"soft\">" + mark + "</small>"));
    }
    rows.push_back(std::move(cells));
  }
  std::vector<std::string> cost = {"run time"};
  for (const SeriesRow& row : record.rungs) cost.push_back(duration(row.run_time));
  rows.push_back(std::move(cost));
  return html_table(head, rows, LastRow::total);
}

/// Distance of each rung from the last that has a value, against run time.
std::string error_chart(const ConvergeRecord& record, const KeyResult& result) {
  double reference = std::nan(""), limit = std::nan("");
  for (std::size_t k = 0; k < record.rungs.size(); ++k) {
    const LadderPoint p = record.point(k, result.name);
    if (!std::isfinite(p.value)) continue;
    reference = p.value;
    limit = p.half_width;
  }
  if (const auto e = record.extrapolation(result.name)) reference = e->value;
  ChartSeries series{result.what, {}, {}, {}, {}};
  std::vector<std::string> labels;
  for (std::size_t k = 0; k < record.rungs.size(); ++k) {
    const LadderPoint p = record.point(k, result.name);
    series.x.push_back(record.rungs[k].run_time);
    series.y.push_back(std::abs(p.value - reference) * result.factor);
    labels.push_back(record.rungs[k].label);
  }
  if (std::none_of(series.y.begin(), series.y.end(), [](double y) { return y > 0; })) return "";
  const std::vector<double> limits =
      limit > 0 ? std::vector<double>{limit * result.factor} : std::vector<double>{};
  return log_chart(
      {result.what, "run time, s",
       "distance from the last rung" + (result.shown_unit.empty() ? "" : ", " + result.shown_unit)},
      {series}, labels, limits);
}

std::string gains(const ConvergeRecord& record, const std::vector<KeyResult>& results) {
  if (results.empty()) return "<p>No rung came to an end with a result that could be compared.</p>";
  std::string out = "<dl class=\"sentences\">";
  for (const KeyResult& result : results)
    out += "<dt>" + html(result.what) + "</dt><dd>" + html(ladder_sentence(record, result)) + "</dd>";
  return out + "</dl>";
}

}  // namespace

std::string converge_html(const ConvergeRecord& record) {
  const std::vector<KeyResult> all = record.results(), headline = headline_results(record.rungs, all);
  const bool whole =
      std::all_of(record.rungs.begin(), record.rungs.end(), [](const auto& r) { return r.completed(); });
  Page page;
  page.title = "Convergence: " + record.title;
  page.chip = whole ? "completed" : "failed";
  page.lines = {fmt::format("{} over {} rungs of {}", record.process, record.rungs.size(), record.vary),
                record.made_by.command};
  page.sections.push_back(
      {"gains", "What a finer rung changes", gains(record, headline) + notes_list(record.notes)});
  std::string charts;
  for (const KeyResult& result : headline) charts += error_chart(record, result);
  if (!charts.empty())
    page.sections.push_back(
        {"charts", "Error against run time",
         "<p class=\"note\">Distance of each rung's result from that of the last rung, or from the "
         "extrapolated "
         "one where there is an order. Below the dashed line, the 95 % limits of the last rung's sampling, a "
         "distance may be chance.</p><div class=\"charts\">" +
             charts + "</div>"});
  page.sections.push_back(
      {"results", "Results by rung",
       "<p class=\"note\">Means with 95 % confidence limits over the steady part of each run; a value "
       "without "
       "limits is no steady average. Below each, what the step from the rung before did: <b>resolved</b>, a "
       "change of more than three times its limits; <b>changed</b>, beyond its limits; <b>no change</b> "
       "beyond "
       "chance; <b>too short</b> a sampling to tell.</p>" +
           result_table(record, headline) + "<details><summary>all results</summary>" +
           result_table(record, all) + "</details>"});
  page.sections.push_back({"rungs", "Rungs", run_table(record.rungs, RowKind::rung)});
  page.sections.push_back({"provenance", "Where it comes from",
                           provenance_list(record.made_by, "converge.json and converge.csv")});
  return page_html(page);
}

std::string converge_text(const ConvergeRecord& record) {
  const std::vector<KeyResult> headline = headline_results(record.rungs, record.results());
  std::string out = fmt::format("{:<54}", record.vary);
  for (const SeriesRow& row : record.rungs) out += fmt::format(" {:>16}", row.label);
  out += "\n";
  for (const KeyResult& result : headline) {
    out += fmt::format("{:<54}", what_of(result));
    for (std::size_t k = 0; k < record.rungs.size(); ++k)
      out += fmt::format(" {:>16}", cell(record, k, result));
    out += "\n";
  }
  out += fmt::format("{:<54}", "run time");
  for (const SeriesRow& row : record.rungs) out += fmt::format(" {:>16}", duration(row.run_time));
  out += fmt::format("\n{:<54}", "outcome");
  for (const SeriesRow& row : record.rungs) out += fmt::format(" {:>16}", row.outcome);
  out += "\n";
  for (const SeriesRow& row : record.rungs)
    if (!row.message.empty()) out += fmt::format("{}: {}\n", row.label, row.message);
  for (const KeyResult& result : headline)
    out += fmt::format("\n{}. {}\n", result.what, ladder_sentence(record, result));
  for (const std::string& note : record.notes) out += "\nnote: " + note + "\n";
  return out;
}

void write_converge_page(const std::filesystem::path& folder, const ConvergeRecord& record) {
  write_atomically(folder / "converge.json", converge_json(record));
  write_csv(folder / "converge.csv", converge_table(record));
  write_atomically(folder / "converge.html", converge_html(record));
}

}  // namespace sluice
