// The sections that say how far the numbers can be trusted and what they cost.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/format.h"
#include "reports/run_sections.h"

namespace sluice {
namespace {

/// What the end of a column's name says about its unit, and how a page shows it.
struct ShownUnit {
  const char* suffix;
  const char* title;
  const char* unit;
  double factor;
};
constexpr std::array<ShownUnit, 13> shown_units = {{{"_m3_per_t", "Water per tonne of rock", "m\u00b3/t", 1},
                                                    {"_kg_s", "Mass flow", "t/h", 3.6},
                                                    {"_m3_s", "Volume flow", "m\u00b3/h", 3600},
                                                    {"_m_s", "Speed", "m/s", 1},
                                                    {"_percent", "Shares", "%", 1},
                                                    {"_kg", "Mass", "t", 1e-3},
                                                    {"_Pa", "Pressure", "kPa", 1e-3},
                                                    {"_J", "Energy", "kJ", 1e-3},
                                                    {"_N", "Force", "kN", 1e-3},
                                                    {"_W", "Power", "kW", 1e-3},
                                                    {"_m", "Length", "m", 1},
                                                    {"_s", "Time", "s", 1},
                                                    {"", "", "", 1}}};
constexpr std::size_t most_curves = 6;

struct TimeChart {
  std::string title, unit;
  std::vector<ChartSeries> curves;
};

std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// Columns of one unit share a chart; counts get one each.
std::vector<TimeChart> time_charts(const CsvTable& series) {
  std::vector<TimeChart> charts;
  const std::vector<double> time = series.numbers("time_s");
  for (const std::string& column : series.columns) {
    if (column == "time_s") continue;
    const auto shown = std::find_if(shown_units.begin(), shown_units.end(),
                                    [&](const ShownUnit& u) { return column.ends_with(u.suffix); });
    const std::string name = spoken(column.substr(0, column.size() - std::string(shown->suffix).size()));
    const bool is_count = *shown->suffix == '\0';
    auto chart = std::find_if(charts.begin(), charts.end(), [&](const TimeChart& c) {
      return !is_count && c.title == shown->title && c.curves.size() < most_curves;
    });
    if (chart == charts.end())
      chart = charts.insert(charts.end(),
                            TimeChart{is_count ? name : shown->title, is_count ? "" : shown->unit, {}});
    ChartSeries curve{name, time, series.numbers(column), {}, {}};
    for (double& y : curve.y) y *= shown->factor;
    chart->curves.push_back(std::move(curve));
  }
  return charts;
}

std::string json_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      out += ' ';
    else
      out += c;
  }
  return out + '"';
}

std::string json_numbers(const std::vector<double>& values) {
  std::string out;
  for (const double v : values)
    out += (out.empty() ? "" : ",") + (std::isfinite(v) ? fmt::format("{:.6g}", v) : "null");
  return "[" + out + "]";
}

std::string label_of(const TimeChart& chart) {
  return chart.unit.empty() ? chart.title : chart.title + ", " + chart.unit;
}

std::string good_or_bad(bool good, const std::string& yes, const std::string& no) {
  return fmt::format("<span class=\"{}\">{}</span>", good ? "good" : "bad", good ? yes : no);
}

/// The words for whether a phase's budget closes as it must.
std::string budget_verdict(const char* phase, const BudgetEntry& b) {
  const double scale = std::max({b.initial_kg + b.entered_kg, 1e-300});
  const double missing = b.requested_kg - b.entered_kg - b.waiting_kg;
  const bool kept = std::abs(b.lost_kg) <= 1e-12 * scale;
  const bool fed = std::abs(missing) <= 1e-9 * std::max(b.requested_kg, 1e-300);
  return fmt::format(
      "<li>{}: {}; {}</li>", phase,
      good_or_bad(kept, "nothing lost", fmt::format("{} kg lost", number(b.lost_kg))),
      good_or_bad(fed, "what entered is rate times time",
                  fmt::format("{} kg of what was requested neither entered nor waits", number(missing))));
}

}  // namespace

std::string series_json(const CsvTable& series) {
  std::string out = "{\"time\":" + json_numbers(series.numbers("time_s")) + ",\"charts\":[";
  const std::vector<TimeChart> charts = time_charts(series);
  for (std::size_t k = 0; k < charts.size(); ++k) {
    std::string names, values;
    for (const ChartSeries& curve : charts[k].curves) {
      names += (names.empty() ? "" : ",") + json_text(curve.name);
      values += (values.empty() ? "" : ",") + json_numbers(curve.y);
    }
    out += fmt::format("{}{{\"id\":\"time-chart-{}\",\"label\":{},\"names\":[{}],\"values\":[{}]}}",
                       k > 0 ? "," : "", k, json_text(label_of(charts[k])), names, values);
  }
  return out + "]}";
}

PageSection series_section(const RunResults& run) {
  PageSection section{"series", "Over time", ""};
  if (!run.series || run.series->rows.empty()) return section;
  section.body =
      "<p class=\"note\">Drag over a chart to zoom in, double-click to zoom out.</p><div class=\"charts\">";
  const std::vector<TimeChart> charts = time_charts(*run.series);
  for (std::size_t k = 0; k < charts.size(); ++k)
    section.body += fmt::format(
        "<div class=\"time-chart\"><h4>{}</h4><div id=\"time-chart-{}\">{}</div></div>",
        html(label_of(charts[k])), k, line_chart({"", "time, s", label_of(charts[k])}, charts[k].curves));
  section.body += "</div>";
  return section;
}

PageSection budget_section(const RunResults& run) {
  PageSection section{"budgets", "Mass budgets", ""};
  const auto& b = run.manifest.budgets;
  std::vector<std::pair<std::string, const BudgetEntry*>> phases;
  if (b.rock) phases.emplace_back("rock", &*b.rock);
  if (b.water) phases.emplace_back("water with its fines", &*b.water);
  if (b.fines) phases.emplace_back("of it fines", &*b.fines);
  if (phases.empty()) return section;
  std::vector<std::string> head = {"kg"};
  for (const auto& [name, budget] : phases) head.push_back(name);
  std::vector<std::vector<std::string>> rows;
  const auto row = [&](const std::string& name, const auto& value) {
    rows.push_back({name});
    for (const auto& [phase, budget] : phases) rows.back().push_back(number(value(*budget), 5));
  };
  row("requested by feeds and nozzles (rate times time)",
      [](const BudgetEntry& p) { return p.requested_kg; });
  row("of it waiting for room", [](const BudgetEntry& p) { return p.waiting_kg; });
  row("inside at the start", [](const BudgetEntry& p) { return p.initial_kg; });
  row("entered", [](const BudgetEntry& p) { return p.entered_kg; });
  row("inside at the end", [](const BudgetEntry& p) { return p.inside_kg; });
  std::vector<std::string> exits;
  for (const auto& [phase, budget] : phases)
    for (const auto& [exit, kg] : budget->left_kg)
      if (std::find(exits.begin(), exits.end(), exit) == exits.end()) exits.push_back(exit);
  for (const std::string& exit : exits)
    row(exit == "outside" ? "left through the open sides of the domain" : "left through " + html(exit),
        [&](const BudgetEntry& p) {
          for (const auto& [name, kg] : p.left_kg)
            if (name == exit) return kg;
          return std::nan("");
        });
  row("lost (start + entered \u2212 inside \u2212 left)", [](const BudgetEntry& p) { return p.lost_kg; });
  section.body = html_table(head, rows, LastRow::total);
  return section;
}

PageSection trust_section(const RunResults& run) {
  const RunManifest& m = run.manifest;
  std::string body = "<h3>Warnings</h3>";
  if (m.warnings.empty()) {
    body += "<p class=\"good\">None.</p>";
  } else {
    body += "<ul class=\"warnings\">";
    for (const std::string& w : m.warnings) body += "<li>" + html(w) + "</li>";
    body += "</ul>";
  }
  body += "<h3>Balances</h3><ul>";
  if (m.budgets.rock) body += budget_verdict("Rock", *m.budgets.rock);
  if (m.budgets.water) body += budget_verdict("Water", *m.budgets.water);
  if (const auto& r = m.budgets.momentum_residual_N_s)
    body += fmt::format("<li>Residual of the momentum balance: {} N\u00b7s</li>",
                        number(std::hypot((*r)[0], (*r)[1], (*r)[2])));
  body += "</ul>";
  if (m.overlap)
    body +=
        "<h3>How soft the rocks are</h3><p class=\"note\">Rocks may overlap a little where they touch; real "
        "ones "
        "deform far less. Overlap in percent of the radius, over the run.</p><div class=\"cards\">" +
        card(number(m.overlap->mean_percent_of_radius, 2), "%", "mean") +
        card(number(m.overlap->p99_percent_of_radius, 2), "%", "99 of 100 contacts are below") +
        card(number(m.overlap->max_percent_of_radius, 2), "%", "largest") + "</div>";
  body += "<h3>Time steps</h3><dl>";
  const auto step = [&](const char* what, std::optional<double> dt, std::optional<std::int64_t> n,
                        const std::string& governed) {
    if (!dt) return;
    body += fmt::format("<dt>{}</dt><dd>{} \u00b5s{}{}</dd>", what, number(1e6 * *dt),
                        n ? ", " + count(static_cast<double>(*n)) + " steps" : "",
                        governed.empty() ? "" : ", set by " + html(governed));
  };
  step("rock", m.time.dt_rock_s, m.time.rock_steps, m.time.rock_step_governed_by);
  step("water", m.time.dt_fluid_s, m.time.fluid_steps, m.time.fluid_step_governed_by);
  body += "</dl>";
  if (!m.budgets.energy.empty()) {
    std::vector<std::vector<std::string>> rows;
    for (const auto& [name, joule] : m.budgets.energy) {
      std::string term = name.ends_with("_J") ? name.substr(0, name.size() - 2) : name;
      rows.push_back({html(spoken(term)), number(joule / 1000, 4)});
    }
    body += "<details><summary>Energy terms</summary>" + html_table({"term", "kJ"}, rows) + "</details>";
  }
  return {"trust", "How far to trust it", body};
}

PageSection cost_section(const RunResults& run) {
  const RunManifest& m = run.manifest;
  double total = 0, most = 0;
  for (const auto& s : m.stages) {
    total += s.seconds;
    most = std::max(most, s.seconds);
  }
  std::vector<std::vector<std::string>> rows;
  for (const auto& s : m.stages)
    rows.push_back({html(s.name), count(static_cast<double>(s.calls)), number(s.seconds),
                    number(s.calls > 0 ? 1e3 * s.seconds / static_cast<double>(s.calls) : std::nan("")),
                    number(total > 0 ? 100 * s.seconds / total : 0, 2) +
                        fmt::format("<span class=\"bar\" style=\"width:{:.0f}px\"></span>",
                                    most > 0 ? 90 * s.seconds / most : 0)});
  rows.push_back({"all stages", "", number(total), "", ""});
  std::string body = "<div class=\"cards\">" + card(duration(m.time.wall_s), "", "computing time");
  if (m.time.simulated_s > 0)
    body += card(duration(m.time.wall_s / m.time.simulated_s), "", "computing time per simulated second");
  body += card(memory(static_cast<double>(m.memory.peak_bytes)), "", "memory at most");
  if (m.rates.rock_steps_per_s)
    body += card(number(*m.rates.rock_steps_per_s / 1e6), "million", "rock steps per second");
  if (m.rates.water_point_steps_per_s)
    body += card(number(*m.rates.water_point_steps_per_s / 1e6), "million", "water point steps per second");
  body += "</div><h3>Stages of a step</h3>" +
          html_table({"stage", "calls", "time<br>s", "per call<br>ms", "share<br>%"}, rows, LastRow::total);
  return {"cost", "Cost", body};
}

PageSection provenance_section(const RunResults& run) {
  const RunManifest& m = run.manifest;
  std::string body = "<dl>";
  const auto line = [&](const char* what, const std::string& value) {
    body += fmt::format("<dt>{}</dt><dd>{}</dd>", what, value.empty() ? "\u2013" : html(value));
  };
  line("Sluice", m.sluice.version + " (" + m.sluice.commit + ")");
  line("compiler", m.sluice.compiler);
  line("flags", m.sluice.flags);
  line("machine", fmt::format("{}, {} threads", m.machine.cpu, m.machine.threads));
  line("process", m.process.file);
  line("SHA-256 of the process", m.process.sha256);
  line("hash of the final state", m.state_hash);
  const auto sizes = [&](const char* what, std::optional<std::int64_t> n, std::optional<std::int64_t> most) {
    if (n)
      line(what,
           count(static_cast<double>(*n)) + (most ? ", at most " + count(static_cast<double>(*most)) : ""));
  };
  sizes("rocks", m.counts.rocks, m.counts.rocks_max);
  if (m.resolved)
    line("rocks that water meets with their own shape",
         fmt::format("whole from {:.3g} mm on, at most {} at once; in part from {:.3g} mm, {}",
                     1e3 * m.resolved->from_m, m.resolved->rocks_max, 1e3 * m.resolved->partly_from_m,
                     m.resolved->rocks_partly_max));
  sizes("water points", m.counts.water_points, m.counts.water_points_max);
  line("wall triangles", count(static_cast<double>(m.counts.wall_triangles)));
  body +=
      "</dl><p class=\"note\">The same process, program and processor give the same state hash for any "
      "number of "
      "threads and across a restart. The numbers behind this page are in run.json, series.csv, exits.csv, "
      "mixing.csv and walls.csv beside it; ParaView opens frames/*.pvd.</p>";
  return {"provenance", "Where it comes from", body};
}

}  // namespace sluice
