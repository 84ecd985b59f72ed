#include "reports/run_page.h"

#include <fmt/format.h>

#include "reports/format.h"
#include "reports/run_sections.h"

namespace sluice {
namespace {

std::string outcome_word(Outcome outcome) {
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

std::string run_line(const RunManifest& m) {
  std::string line = fmt::format("{} simulated", duration(m.time.simulated_s));
  if (m.time.planned_s) line += fmt::format(" of {} asked for", duration(*m.time.planned_s));
  line += fmt::format(", computed in {} on {} thread{}", duration(m.time.wall_s), m.machine.threads,
                      m.machine.threads == 1 ? "" : "s");
  return line;
}

}  // namespace

void write_run_page(const std::filesystem::path& run_folder) {
  const RunResults run = read_results(run_folder);
  Page page;
  page.title = run.title();
  page.chip = outcome_word(run.manifest.outcome);
  page.lines = {run_line(run.manifest)};
  if (!run.manifest.process.file.empty()) page.lines.push_back(run.manifest.process.file);
  for (PageSection section :
       {summary_section(run), picture_section(run), view_section(run), exit_section(run), series_section(run),
        mixing_section(run), wall_section(run), budget_section(run), trust_section(run), cost_section(run),
        provenance_section(run)})
    if (!section.body.empty()) page.sections.push_back(std::move(section));
  if (run.view) page.data.emplace_back("view-data", view_text(*run.view));
  if (run.series) page.data.emplace_back("series-data", series_json(*run.series));
  write_atomically(run.folder.report(), page_html(page));
}

}  // namespace sluice
