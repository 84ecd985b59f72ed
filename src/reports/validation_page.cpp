#include "reports/validation_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "output/run_folder.h"
#include "reports/format.h"
#include "reports/log_chart.h"
#include "reports/page_shell.h"

namespace sluice {

namespace {

constexpr std::size_t values_shown = 12;  // of the last rung; the file has all

std::string significant(double x) {
  return std::isfinite(x) ? fmt::format("{:.3g}", x) : "-";
}
std::string significant(const std::optional<double>& x) {
  return x ? significant(*x) : "-";
}

/// One line on a rung's outcome.
std::string verdict(const ValidationRung& r) {
  if (!r.stable) return "unstable";
  if (!r.gate) return "recorded";
  return r.passed() ? "pass" : "FAIL";
}
std::string verdict(const ValidationCase& c) {
  return c.passed() ? "pass" : "FAIL";
}
std::string stability(const ValidationRung& r) {
  if (!r.stable) return r.message;
  return r.message.empty() ? "yes" : "yes, " + r.message;
}
std::string coloured(const std::string& word) {
  const bool bad = word == "FAIL" || word == "unstable";
  return fmt::format("<span class=\"{}\">{}</span>", bad ? "bad" : word == "pass" ? "good" : "soft", word);
}

std::string order_words(const ValidationCase& c) {
  std::string words = significant(c.order);
  if (c.least_order) words += fmt::format(" (at least {})", significant(c.least_order));
  return words;
}

const ValidationRung* last_rung(const ValidationCase& c) {
  return c.rungs.empty() ? nullptr : &c.rungs.back();
}

std::string provenance(const MadeBy& r) {
  return fmt::format("Sluice {} (commit {}), {} `{}`, {} threads on {}", r.version, r.commit, r.compiler,
                     r.flags, r.threads, r.cpu);
}

std::string overview(const ValidationRecord& record) {
  std::vector<std::vector<std::string>> rows;
  for (const ValidationCase& c : record.cases) {
    const ValidationRung* last = last_rung(c);
    double seconds = 0;
    for (const ValidationRung& r : c.rungs) seconds += r.seconds;
    rows.push_back({fmt::format("<a href=\"#{0}\">{0}</a>", html(c.name)), html(c.group),
                    last ? significant(last->error) : "-", last ? significant(last->gate) : "-",
                    order_words(c), duration(seconds), coloured(verdict(c))});
  }
  const std::string note =
      record.of_one_build()
          ? ""
          : "<p class=\"note\">Not all cases were run by one build: each says by which.</p>";
  return note +
         html_table({"case", "group", "error, last rung", "gate", "order", "run time", "outcome"}, rows);
}

std::string rung_table(const ValidationCase& c) {
  std::vector<std::vector<std::string>> rows;
  for (const ValidationRung& r : c.rungs)
    rows.push_back({html(r.setting), significant(r.error), significant(r.gate), significant(r.seconds),
                    significant(r.nanoseconds()), html(stability(r)), coloured(verdict(r)),
                    "<code>" + html(r.command) + "</code>"});
  return html_table({html(c.vary), "error", "gate", "seconds", "ns per " + c.particle + "-step", "stable",
                     "outcome", "command"},
                    rows);
}

std::string value_table(const ValidationRung& rung) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < std::min(values_shown, rung.values.size()); ++k) {
    const ValidationValue& v = rung.values[k];
    rows.push_back({html(v.what), fmt::format("{:.6g}", v.measured), fmt::format("{:.6g}", v.reference)});
  }
  std::string out = html_table({"value at " + html(rung.setting), "measured", "reference"}, rows);
  if (rung.values.size() > values_shown)
    out +=
        fmt::format("<p class=\"note\">{} more in validation.json.</p>", rung.values.size() - values_shown);
  return out;
}

std::string chart_of(const ValidationCase& c) {
  ChartSeries series{"error", {}, {}, {}, {}};
  std::vector<std::string> labels;
  std::vector<double> gates;
  for (const ValidationRung& r : c.rungs) {
    series.x.push_back(r.seconds);
    series.y.push_back(r.error);
    labels.push_back(r.setting);
    if (r.gate) gates.push_back(*r.gate);
  }
  return log_chart({"Error against run time, by " + c.vary, "run time, s", c.norm}, {series}, labels, gates);
}

std::string case_body(const ValidationCase& c) {
  std::string out =
      fmt::format("<p>{} ({}). Norm: {}; observed order: {}.{}</p>", coloured(verdict(c)), html(c.group),
                  html(c.norm), order_words(c), c.whole() ? "" : " Not the whole ladder was run.");
  out += "<p class=\"note\">Reference: " + html(c.source) + "</p><p class=\"note\">" + html(c.why) + "</p>";
  if (!c.shortfall.empty()) out += "<p class=\"note\">Known shortfall: " + html(c.shortfall) + "</p>";
  out += rung_table(c) + chart_of(c);
  if (const ValidationRung* last = last_rung(c); last && !last->values.empty())
    out += "<details><summary>values</summary>" + value_table(*last) + "</details>";
  out += "<p class=\"note\">Run by " + html(provenance(c.made_by)) + "</p>";
  return out + fmt::format("<p class=\"note\">Set-up and physics: validation/{}/README.md</p>", html(c.name));
}

std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\\|");
  return text;
}

}  // namespace

std::string validation_html(const ValidationRecord& record) {
  Page page;
  page.title = "Validation: error against run time";
  page.chip = record.passed() ? "completed" : "failed";
  page.lines = {provenance(record.made_by), record.command};
  page.sections.push_back({"overview", "All cases", overview(record)});
  for (const ValidationCase& c : record.cases) page.sections.push_back({c.name, c.title, case_body(c)});
  return page_html(page);
}

std::string validation_markdown(const ValidationRecord& record) {
  std::string out = fmt::format(
      "# Validation: error against run time\n\n{}\n\nWritten by `{}`. Outcome: {}.\n\n",
      provenance(record.made_by), record.command, record.passed() ? "every gate passed" : "a gate FAILED");
  if (!record.of_one_build()) out += "Not all cases were run by one build: each says by which.\n\n";
  out += "| case | group | error, last rung | gate | order | outcome |\n|---|---|---|---|---|---|\n";
  for (const ValidationCase& c : record.cases) {
    const ValidationRung* last = last_rung(c);
    out += fmt::format("| [{0}](../validation/{0}/README.md) | {1} | {2} | {3} | {4} | {5} |\n", c.name,
                       c.group, last ? significant(last->error) : "-", last ? significant(last->gate) : "-",
                       order_words(c), verdict(c));
  }
  for (const ValidationCase& c : record.cases) {
    out += fmt::format("\n## {}: {}\n\n{}. Norm: {}; observed order: {}. Reference: {}\n\n{}{}\n\n", c.name,
                       c.title, verdict(c), c.norm, order_words(c), c.source, c.why,
                       c.shortfall.empty() ? "" : " Known shortfall: " + c.shortfall);
    out += "Run by " + provenance(c.made_by) + "\n\n";
    out += fmt::format("| {} | error | gate | seconds | ns per {}-step | stable | outcome | command |\n",
                       c.vary, c.particle);
    out += "|---|---|---|---|---|---|---|---|\n";
    for (const ValidationRung& r : c.rungs)
      out += fmt::format("| {} | {} | {} | {} | {} | {} | {} | `{}` |\n", r.setting, significant(r.error),
                         significant(r.gate), significant(r.seconds), significant(r.nanoseconds()),
                         cell(stability(r)), verdict(r), r.command);
  }
  return out;
}

void write_validation_page(const std::filesystem::path& folder, const ValidationRecord& record) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw EnvironmentError(fmt::format("{} cannot be made: {}", folder.string(), error.message()));
  write_validation_json(folder / "validation.json", record);
  write_atomically(folder / "validation.html", validation_html(record));
  write_atomically(folder / "validation.md", validation_markdown(record));
}

}  // namespace sluice
