#include "reports/extremes_page.h"

#include <fmt/format.h>

#include <cmath>

#include "base/errors.h"
#include "output/run_folder.h"
#include "reports/format.h"
#include "reports/page_shell.h"

namespace sluice {

namespace {

constexpr const char* introduction =
    "Each case makes one setting of a small process harder, rung by rung. A rung runs to its end with every "
    "kilogram accounted for and every number finite; or it stops (exit code 3), or is refused (exit code 2), "
    "with a message whose remedy was tried and works. A rung of too many steps is cut short, and says where. "
    "The frontier is the last rung that ran before the first that did not.";

std::string provenance(const ExtremesRecord& r) {
  return fmt::format("Sluice {} (commit {}), {} `{}`, {} threads on {}", r.version, r.commit, r.compiler,
                     r.flags, r.threads, r.cpu);
}

std::string frontier_words(const ExtremeCase& c) {
  const ExtremeRung* last = c.frontier();
  return last == nullptr ? "-" : last->setting;
}

std::string beyond_words(const ExtremeCase& c) {
  const ExtremeRung* first = c.beyond();
  return first == nullptr ? "-" : fmt::format("{} {}", first->setting, outcome_word(first->outcome));
}

std::string outcome_of(const ExtremeRung& r) {
  std::string words = outcome_word(r.outcome);
  if (r.outcome != r.expected) words += fmt::format(" (expected: {})", outcome_word(r.expected));
  return words;
}

std::string remedy_of(const ExtremeRung& r) {
  if (r.remedy.empty()) return "";
  return fmt::format("{}: {}{}", r.remedy, r.remedy_works ? "runs" : "DOES NOT RUN",
                     r.remedy_named ? "" : ", not named by the message");
}

std::string foreseen(const ExtremeRung& r) {
  return fmt::format("{}", fmt::join(r.warnings, "; "));
}

/// Overlap, created energy and Mach number, where there are rocks and water.
std::string figures(const ExtremeRung& r) {
  std::string words;
  const auto add = [&](const std::string& word) { words += (words.empty() ? "" : ", ") + word; };
  if (r.overlap > 0) add(fmt::format("overlap {:.3g} %", r.overlap));
  if (std::abs(r.created) > 0) add(fmt::format("energy {:+.2g} %", r.created));
  if (r.mach > 0) add(fmt::format("Mach {:.2g}", r.mach));
  return words;
}

std::string coloured(const std::string& word, bool good) {
  return fmt::format("<span class=\"{}\">{}</span>", good ? "good" : "bad", html(word));
}

std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\\|");
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos;) text.replace(at, 1, " ");
  return text;
}

std::string case_body(const ExtremeCase& c) {
  std::vector<std::vector<std::string>> rows;
  for (const ExtremeRung& r : c.rungs)
    rows.push_back({html(r.setting), coloured(outcome_of(r), r.good()), html(figures(r)),
                    fmt::format("{:.3g}", r.steps), fmt::format("{:.2g}", r.seconds), html(r.message),
                    html(remedy_of(r)), html(foreseen(r)), "<code>" + html(r.command) + "</code>"});
  return fmt::format("<p>Expected: {}. Scene: validation/extremes/scenes/{}.</p>", html(c.expect),
                     html(c.scene)) +
         html_table({html(c.vary), "outcome", "largest", "steps", "seconds", "what it says", "remedy tried",
                     "check says beforehand", "command"},
                    rows);
}

}  // namespace

std::string extremes_html(const ExtremesRecord& record) {
  Page page;
  page.title = "Extremes: how far each setting goes";
  page.chip = record.good() ? "completed" : "failed";
  page.lines = {provenance(record), fmt::format("{}, {}", record.command, duration(record.seconds))};
  std::vector<std::vector<std::string>> rows;
  for (const ExtremeCase& c : record.cases)
    rows.push_back({fmt::format("<a href=\"#{0}\">{0}</a>", html(c.name)), html(c.group), html(c.title),
                    html(frontier_words(c)), html(beyond_words(c)), html(c.margin()),
                    coloured(c.good() ? "as expected" : "NOT as expected", c.good())});
  page.sections.push_back({"overview", "All cases",
                           "<p>" + html(introduction) + "</p>" +
                               html_table({"case", "group", "what", "last that ran", "first that did not",
                                           "margin of the defaults", "outcome"},
                                          rows)});
  for (const ExtremeCase& c : record.cases) page.sections.push_back({c.name, c.title, case_body(c)});
  return page_html(page);
}

std::string extremes_markdown(const ExtremesRecord& record) {
  std::string out = fmt::format(
      "# Extremes: how far each setting goes\n\n{}\n\nWritten by `{}` in {}. Outcome: {}.\n\n{}\n\n",
      provenance(record), record.command, duration(record.seconds),
      record.good() ? "every rung as expected" : "a rung is NOT as expected", introduction);
  out +=
      "| case | group | what | last that ran | first that did not | margin of the defaults | as expected |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const ExtremeCase& c : record.cases)
    out += fmt::format("| [{0}](../validation/extremes/{0}.yaml) | {1} | {2} | {3} | {4} | {5} | {6} |\n",
                       c.name, c.group, cell(c.title), frontier_words(c), beyond_words(c), cell(c.margin()),
                       c.good() ? "yes" : "NO");
  for (const ExtremeCase& c : record.cases) {
    out += fmt::format("\n## {}: {}\n\nExpected: {}.\n\n", c.name, c.title, c.expect);
    out += fmt::format(
        "| {} | outcome | largest | steps | seconds | what it says | remedy tried | check says beforehand |\n"
        "|---|---|---|---|---|---|---|---|\n",
        c.vary);
    for (const ExtremeRung& r : c.rungs)
      out +=
          fmt::format("| {} | {} | {} | {:.3g} | {:.2g} | {} | {} | {} |\n", r.setting, outcome_of(r),
                      figures(r), r.steps, r.seconds, cell(r.message), cell(remedy_of(r)), cell(foreseen(r)));
  }
  return out;
}

void write_extremes_page(const std::filesystem::path& folder, const ExtremesRecord& record) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw EnvironmentError(fmt::format("{} cannot be made: {}", folder.string(), error.message()));
  write_atomically(folder / "extremes.html", extremes_html(record));
  write_atomically(folder / "extremes.md", extremes_markdown(record));
}

}  // namespace sluice
