#include "reports/series_sections.h"

#include <fmt/format.h>

#include <cmath>

#include "reports/format.h"
#include "reports/page_shell.h"

namespace sluice {

std::string run_table(const std::vector<SeriesRow>& rows, RowKind kind) {
  std::vector<std::vector<std::string>> cells;
  const auto micro = [](std::optional<double> s) { return number(s ? 1e6 * *s : std::nan("")); };
  for (const SeriesRow& row : rows) {
    const std::string outcome =
        fmt::format("<span class=\"{}\">{}</span>", row.completed() ? "good" : "bad", html(row.outcome)) +
        (row.message.empty() ? "" : ": " + html(row.message));
    std::vector<std::string> line = {html(row.label)};
    if (kind == RowKind::variation) line.push_back(row.seed ? std::to_string(*row.seed) : "");
    line.insert(
        line.end(),
        {outcome, number(row.simulated), duration(row.run_time), memory(row.memory), micro(row.rock_step),
         micro(row.water_step), row.rocks ? count(*row.rocks) : number(row.rocks),
         row.water_points ? count(*row.water_points) : number(row.water_points),
         "<code>" + html(row.state_hash) + "</code>", "<code>" + html(row.command) + "</code>"});
    cells.push_back(std::move(line));
  }
  std::vector<std::string> head = {kind == RowKind::rung ? "rung" : "variation"};
  if (kind == RowKind::variation) head.emplace_back("seed");
  for (const char* word :
       {"outcome", "simulated<br>s", "run time", "memory", "rock step<br>\u00b5s", "water step<br>\u00b5s",
        "rocks<br>at most", "water points<br>at most", "state", "command"})
    head.emplace_back(word);
  return html_table(head, cells);
}

std::string notes_list(const std::vector<std::string>& notes) {
  if (notes.empty()) return "";
  std::string out = "<ul class=\"warnings\">";
  for (const std::string& note : notes) out += "<li>" + html(note) + "</li>";
  return out + "</ul>";
}

std::string provenance_list(const SeriesProvenance& p, const std::string& files) {
  return fmt::format(
      "<p>Sluice {} ({}), {} <code>{}</code>, {} threads on {}.</p><p>Made by <code>{}</code>; the numbers "
      "are in "
      "{} beside this page, and each run's own page in its folder. Run times compare only where nothing else "
      "ran "
      "on the machine.</p>",
      html(p.version), html(p.commit), html(p.compiler), html(p.flags), p.threads, html(p.cpu),
      html(p.command), html(files));
}

}  // namespace sluice
