#include "reports/study_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/run_folder.h"
#include "reports/comparison_page.h"
#include "reports/format.h"
#include "reports/series_sections.h"
#include "reports/series_words.h"

namespace sluice {

namespace {

std::size_t pairs_of(const StudyRecord& record, const StudyClaim& claim) {
  const std::vector<double> a = record.values(claim.first, claim.result),
                            b = record.values(claim.other, claim.result);
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    pairs += std::isfinite(a[i]) && std::isfinite(b[i]) ? 1 : 0;
  return pairs;
}

std::string style_of(ClaimVerdict verdict) {
  return verdict == ClaimVerdict::holds ? "good" : verdict == ClaimVerdict::does_not_hold ? "bad" : "soft";
}

KeyResult result_named(const StudyRecord& record, const std::string& name) {
  for (const KeyResult& r : record.results())
    if (r.name == name) return r;
  KeyResult unknown;
  unknown.name = unknown.what = name;
  return unknown;
}

/// What the claim rests on, without the claim itself.
std::string grounds_of(const StudyRecord& record, const StudyClaim& claim) {
  const KeyResult result = result_named(record, claim.result);
  const std::size_t pairs = pairs_of(record, claim);
  if (pairs == 0) return fmt::format("No pair of runs has '{}'.", result.what);
  const Estimate first = record.estimate(claim.first, claim.result),
                 other = record.estimate(claim.other, claim.result);
  const Estimate& d = claim.outcome.difference;
  std::string text = fmt::format("{}: {} with {}, {} with {}; seed by seed they differ by {} over {} seed{}",
                                 result.what, shown(result, first.value, first.half_width), claim.first,
                                 shown(result, other.value, other.half_width), claim.other,
                                 shown(result, d.value, d.half_width), pairs, pairs == 1 ? "" : "s");
  if (claim.kind == ClaimKind::alike)
    text += fmt::format(", where {} ({} %) is allowed",
                        shown(result, claim.margin * std::abs(claim.outcome.reference), std::nan("")),
                        number(100 * claim.margin, 2));
  if (pairs < fewest_seeds) text += fmt::format("; a claim needs {}", fewest_seeds);
  return text + ".";
}

std::string claim_list(const StudyRecord& record) {
  std::string out;
  for (const StudyClaim& claim : record.claims)
    out += fmt::format("<h3>{}: <span class=\"{}\">{}</span></h3><p>{}</p>", html(claim.text),
                       style_of(claim.outcome.verdict), word_of(claim.outcome.verdict),
                       html(grounds_of(record, claim)));
  return out;
}

std::string result_table(const StudyRecord& record, const std::vector<KeyResult>& results) {
  std::vector<std::string> head = {""};
  for (std::size_t k = 0; k < record.variations.size(); ++k)
    head.push_back(fmt::format("<span style=\"color:{}\">\u25a0</span> {}", series_colour(k),
                               html(record.variations[k])));
  std::vector<std::vector<std::string>> rows;
  for (const KeyResult& result : results) {
    std::vector<std::string> cells = {
        html(result.shown_unit.empty() ? result.what : result.what + ", " + result.shown_unit)};
    KeyResult plain = result;
    plain.shown_unit.clear();
    for (const std::string& variation : record.variations) {
      const Estimate e = record.estimate(variation, result.name);
      cells.push_back(shown(plain, e.value, e.half_width));
    }
    rows.push_back(std::move(cells));
  }
  return html_table(head, rows);
}

/// Runs of one variation that have exits.csv.
std::vector<RunResults> runs_of(const StudyRecord& record, const std::string& variation) {
  std::vector<RunResults> runs;
  for (const SeriesRow& row : record.runs)
    if (row.label == variation && row.completed()) runs.push_back(read_results(row.folder));
  return runs;
}

/// Mean over the seeds of a quantity across the width of an exit, with limits over the seeds.
ChartSeries over_seeds(const std::vector<RunResults>& runs, const std::string& exit, const ExitQuantity& q,
                       std::vector<double>& edges) {
  ChartSeries series;
  std::vector<std::vector<double>> bins;
  for (const RunResults& run : runs) {
    if (!run.exits) continue;
    for (const ExitDistribution& e : exit_distributions(*run.exits)) {
      if (e.exit != exit) continue;
      if (edges.empty()) edges = e.edges;
      if (e.edges != edges) continue;  // another width: it cannot be averaged with these
      const std::vector<double> values = exit_values(*run.exits, e, q.column, q.factor, q.per);
      bins.resize(values.size());
      for (std::size_t i = 0; i < values.size(); ++i)
        if (std::isfinite(values[i])) bins[i].push_back(values[i]);
    }
  }
  for (const std::vector<double>& values : bins) {
    const Estimate e = replicate_mean(values);
    series.y.push_back(e.value);
    series.low.push_back(e.value - e.half_width);
    series.high.push_back(e.value + e.half_width);
  }
  return series;
}

std::string exit_charts(const StudyRecord& record) {
  std::vector<std::vector<RunResults>> runs;
  std::vector<std::string> exits;
  for (const std::string& variation : record.variations) {
    runs.push_back(runs_of(record, variation));
    for (const RunResults& run : runs.back())
      for (const auto& e : run.manifest.exits)
        if (std::find(exits.begin(), exits.end(), e.name) == exits.end()) exits.push_back(e.name);
  }
  std::string out;
  for (const std::string& exit : exits) {
    std::string charts;
    for (const ExitQuantity& q : exit_quantities()) {
      std::vector<double> edges;
      std::vector<ChartSeries> series;
      bool any = false;
      for (std::size_t k = 0; k < runs.size(); ++k) {
        series.push_back(over_seeds(runs[k], exit, q, edges));
        series.back().name = record.variations[k];
        any = any || std::any_of(series.back().y.begin(), series.back().y.end(),
                                 [](double y) { return std::isfinite(y) && y != 0; });
      }
      if (any) charts += bin_chart({q.title, "across the width, m", q.unit}, edges, series);
    }
    if (!charts.empty()) out += "<h3>" + html(exit) + "</h3><div class=\"charts\">" + charts + "</div>";
  }
  return out;
}

/// The first run of each variation that has something to show.
std::vector<std::filesystem::path> first_runs(const StudyRecord& record) {
  std::vector<std::filesystem::path> folders;
  for (const std::string& variation : record.variations)
    for (const SeriesRow& row : record.runs)
      if (row.label == variation && !row.state_hash.empty()) {
        folders.push_back(row.folder);
        break;
      }
  return folders;
}

}  // namespace

std::string claim_sentence(const StudyRecord& record, const StudyClaim& claim) {
  return fmt::format("{}: {}. {}", claim.text, word_of(claim.outcome.verdict), grounds_of(record, claim));
}

std::string study_html(const StudyRecord& record) {
  const std::vector<KeyResult> all = record.results(), headline = headline_results(record.runs, all);
  const bool whole =
      std::all_of(record.runs.begin(), record.runs.end(), [](const auto& r) { return r.completed(); });
  Page page;
  page.title = record.title;
  page.chip = whole ? "completed" : "failed";
  page.lines = {fmt::format("{} variations, {} runs", record.variations.size(), record.runs.size()),
                record.made_by.command};
  if (!record.claims.empty())
    page.sections.push_back({"claims", "Claims", claim_list(record) + notes_list(record.notes)});
  page.sections.push_back(
      {"results", "Results",
       std::string(
           "<p class=\"note\">Means over the seeds with 95 % confidence limits from their scatter; one "
           "variation's runs share their seeds with the others', and so their sequence of rocks.</p>") +
           result_table(record, headline) + "<details><summary>all results</summary>" +
           result_table(record, all) + "</details>" +
           (record.claims.empty() ? notes_list(record.notes) : "")});
  if (const std::string charts = exit_charts(record); !charts.empty())
    page.sections.push_back(
        {"seeds", "Exits",
         "<p class=\"note\">Means over the seeds; whiskers are their 95 % limits (four seeds at "
         "least).</p>" +
             charts});
  if (const auto folders = first_runs(record); !folders.empty())
    for (PageSection& section : comparison_page(folders, record.title).sections) {
      if (section.id == "exits" || section.id == "provenance") continue;
      if (section.id == "summary") section.heading = "First run of each";
      page.sections.push_back(std::move(section));
    }
  page.sections.push_back({"runs", "Runs", run_table(record.runs, RowKind::variation)});
  page.sections.push_back(
      {"provenance", "Where it comes from", provenance_list(record.made_by, "study.json and study.csv")});
  return page_html(page);
}

std::string study_text(const StudyRecord& record) {
  std::string out = fmt::format("{:<54}", "");
  for (const std::string& variation : record.variations) out += fmt::format(" {:>18}", variation);
  out += "\n";
  for (const KeyResult& result : headline_results(record.runs, record.results())) {
    KeyResult plain = result;
    plain.shown_unit.clear();
    out += fmt::format("{:<54}",
                       result.shown_unit.empty() ? result.what : result.what + ", " + result.shown_unit);
    for (const std::string& variation : record.variations) {
      const Estimate e = record.estimate(variation, result.name);
      out += fmt::format(" {:>18}", shown(plain, e.value, e.half_width));
    }
    out += "\n";
  }
  for (const SeriesRow& row : record.runs)
    if (!row.completed())
      out += fmt::format("{}{}: {} {}\n", row.label, row.seed ? fmt::format(", seed {}", *row.seed) : "",
                         row.outcome, row.message);
  for (const StudyClaim& claim : record.claims) out += "\n" + claim_sentence(record, claim) + "\n";
  for (const std::string& note : record.notes) out += "\nnote: " + note + "\n";
  return out;
}

void write_study_page(const std::filesystem::path& folder, const StudyRecord& record) {
  write_atomically(folder / "study.json", study_json(record));
  write_csv(folder / "study.csv", study_table(record));
  write_atomically(folder / "study.html", study_html(record));
}

}  // namespace sluice
