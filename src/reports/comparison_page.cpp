#include "reports/comparison_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "reports/format.h"
#include "reports/page_shell.h"
#include "reports/picture.h"

namespace sluice {
namespace {

using Cell = std::function<std::string(const RunResults&)>;

/// Names that tell the runs apart: the titles, with the folder where titles are alike.
std::vector<std::string> names_of(const std::vector<RunResults>& runs) {
  std::vector<std::string> names;
  for (const RunResults& run : runs) {
    const auto alike =
        std::count_if(runs.begin(), runs.end(), [&](const auto& r) { return r.title() == run.title(); });
    const std::string folder =
        std::filesystem::absolute(run.folder.root).lexically_normal().filename().string();
    names.push_back(alike > 1 ? fmt::format("{} ({})", run.title(), folder) : run.title());
  }
  return names;
}

std::vector<std::string> exits_of(const std::vector<RunResults>& runs) {
  std::vector<std::string> exits;
  for (const RunResults& run : runs)
    for (const auto& e : run.manifest.exits)
      if (std::find(exits.begin(), exits.end(), e.name) == exits.end()) exits.push_back(e.name);
  return exits;
}

std::string key_table(const std::vector<RunResults>& runs, const std::vector<std::string>& names) {
  std::vector<std::string> head = {""};
  for (std::size_t k = 0; k < names.size(); ++k)
    head.push_back(
        fmt::format("<span style=\"color:{}\">\u25a0</span> {}", series_colour(k), html(names[k])));
  std::vector<std::vector<std::string>> rows;
  const auto row = [&](const std::string& name, const Cell& cell) {
    std::vector<std::string> cells = {name};
    for (const RunResults& run : runs) cells.push_back(cell(run));
    // a row in which no run has a value says nothing
    if (std::any_of(cells.begin() + 1, cells.end(),
                    [](const std::string& c) { return c != number(std::nan("")); }))
      rows.push_back(std::move(cells));
  };
  const auto rate = [](const std::optional<BudgetEntry>& b, double time) {
    return b && time > 0 ? number(t_h(b->entered_kg / time)) : number(std::nan(""));
  };
  row("outcome", [](const RunResults& r) {
    switch (r.manifest.outcome) {
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
  });
  row("simulated, s", [](const RunResults& r) { return number(r.manifest.time.simulated_s, 4); });
  row("rock fed, t/h",
      [&](const RunResults& r) { return rate(r.manifest.budgets.rock, r.manifest.time.simulated_s); });
  row("water with its fines let in, t/h",
      [&](const RunResults& r) { return rate(r.manifest.budgets.water, r.manifest.time.simulated_s); });
  using Summary = RunManifest::ExitSummary;
  struct ExitRow {
    const char* what;
    std::optional<double> Summary::*value;
    double factor;
  };
  for (const std::string& exit : exits_of(runs)) {
    for (const ExitRow& e :
         {ExitRow{"rock, t/h", &Summary::rock_kg_s, 3.6},
          ExitRow{"water with its fines, t/h", &Summary::water_kg_s, 3.6},
          ExitRow{"water per rock, m\u00b3/t", &Summary::water_m3_per_t, 1},
          ExitRow{"unevenness of rock across the width (CoV)", &Summary::rock_cov_across_width, 1},
          ExitRow{"the same less shot noise", &Summary::rock_cov_corrected, 1},
          ExitRow{"unevenness of water across the width (CoV)", &Summary::water_cov_across_width, 1},
          ExitRow{"unevenness of water to rock (CoV)", &Summary::water_to_rock_cov, 1},
          ExitRow{"rock left dry, %", &Summary::dry_rock_fraction, 100},
          ExitRow{"P80 of rock, mm", &Summary::rock_size_p80_m, 1000},
          ExitRow{"steady from, s", &Summary::steady_from_s, 1}}) {
      row(html(exit) + ": " + e.what, [&](const RunResults& r) {
        for (const Summary& s : r.manifest.exits)
          if (s.name == exit && s.*e.value) return number(*(s.*e.value) * e.factor);
        return number(std::nan(""));
      });
    }
  }
  row("largest overlap of rocks, % of radius", [](const RunResults& r) {
    return r.manifest.overlap ? number(r.manifest.overlap->max_percent_of_radius, 2) : number(std::nan(""));
  });
  row("warnings", [](const RunResults& r) { return count(static_cast<double>(r.manifest.warnings.size())); });
  row("computing time", [](const RunResults& r) { return duration(r.manifest.time.wall_s); });
  return html_table(head, rows);
}

/// Distributions of one exit laid over each other; runs whose bins differ are drawn apart.
std::string exit_charts(const std::vector<RunResults>& runs, const std::vector<std::string>& names,
                        const std::string& exit) {
  std::string charts;
  for (const ExitQuantity& q : exit_quantities()) {
    std::vector<double> edges;
    std::vector<ChartSeries> series;
    std::string apart;
    bool any = false;
    for (std::size_t k = 0; k < runs.size(); ++k) {
      ChartSeries s{names[k], {}, {}, {}, {}};
      std::vector<double> own_edges;
      if (runs[k].exits) {
        for (const ExitDistribution& e : exit_distributions(*runs[k].exits)) {
          if (e.exit != exit) continue;
          own_edges = e.edges;
          s.y = exit_values(*runs[k].exits, e, q.column, q.factor, q.per);
          s.low = exit_values(*runs[k].exits, e, std::string(q.column) + "_low95", q.factor, q.per);
          s.high = exit_values(*runs[k].exits, e, std::string(q.column) + "_high95", q.factor, q.per);
        }
      }
      if (edges.empty()) edges = own_edges;
      const bool has_values = std::any_of(s.y.begin(), s.y.end(), [](double y) { return std::isfinite(y); });
      if (has_values && own_edges != edges) {
        apart += bin_chart({std::string(q.title) + ", " + names[k], "across the width, m", q.unit}, own_edges,
                           {s});
        s.y.clear();
      }
      any = any || has_values;
      series.push_back(std::move(s));  // empty ones keep the colours in step with the table
    }
    if (any) charts += bin_chart({q.title, "across the width, m", q.unit}, edges, series) + apart;
  }
  return charts;
}

std::string pictures(const std::vector<RunResults>& runs, const std::vector<std::string>& names) {
  SpeedScale scale;
  for (const RunResults& run : runs)
    if (run.view) scale.fastest = std::max(scale.fastest, speed_scale(*run.view).fastest);
  std::string out;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (!runs[k].view) continue;
    const PictureSize size{800, 600, 2};
    const Camera camera = overview_camera(scene_frame(*runs[k].view), size);
    out += "<figure>" +
           inline_picture(png_bytes(draw_picture(*runs[k].view, camera, scale, size)), names[k]) +
           fmt::format("<figcaption>{}, at t = {} s</figcaption></figure>", html(names[k]),
                       number(runs[k].view->time, 4));
  }
  if (out.empty()) return out;
  return "<div class=\"charts\">" + out + "</div>" +
         fmt::format(
             "<div class=\"scale\"><span>speed: 0</span><i "
             "style=\"background:linear-gradient(90deg,{})\"></i>"
             "<span>{} m/s and more, alike in all pictures</span></div>",
             speed_gradient_css(), number(scale.fastest, 2));
}

}  // namespace

Page comparison_page(const std::vector<std::filesystem::path>& run_folders, const std::string& title) {
  std::vector<RunResults> runs;
  for (const auto& folder : run_folders) runs.push_back(read_results(folder));
  const std::vector<std::string> names = names_of(runs);

  Page page;
  page.title = title;
  page.lines = {fmt::format("{} runs", runs.size())};
  page.sections.push_back({"summary", "Key results", key_table(runs, names)});
  if (const std::string figures = pictures(runs, names); !figures.empty())
    page.sections.push_back({"pictures", "Pictures", figures});
  std::string exits;
  for (const std::string& exit : exits_of(runs))
    if (const std::string charts = exit_charts(runs, names, exit); !charts.empty())
      exits += "<h3>" + html(exit) + "</h3><div class=\"charts\">" + charts + "</div>";
  if (!exits.empty())
    page.sections.push_back(
        {"exits", "Exits",
         "<p class=\"note\">Whiskers are 95 % confidence limits of the mean: where they overlap, "
         "the runs do not differ for certain.</p>" +
             exits});
  std::string warnings;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k].manifest.warnings.empty()) continue;
    warnings += "<h3>" + html(names[k]) + "</h3><ul class=\"warnings\">";
    for (const std::string& w : runs[k].manifest.warnings) warnings += "<li>" + html(w) + "</li>";
    warnings += "</ul>";
  }
  if (!warnings.empty()) page.sections.push_back({"warnings", "Warnings", warnings});
  std::string links = "<ul>";
  for (std::size_t k = 0; k < runs.size(); ++k)
    links += fmt::format("<li>{}: {}, Sluice {} ({}), state {}</li>", html(names[k]),
                         html(runs[k].folder.root.string()), html(runs[k].manifest.sluice.version),
                         html(runs[k].manifest.sluice.commit), html(runs[k].manifest.state_hash));
  page.sections.push_back({"provenance", "Where it comes from", links + "</ul>"});
  return page;
}

void write_comparison_page(const std::vector<std::filesystem::path>& run_folders,
                           const std::filesystem::path& out, const std::string& title) {
  write_atomically(out, page_html(comparison_page(run_folders, title)));
}

}  // namespace sluice
