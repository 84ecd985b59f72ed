#include "reports/run_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/format.h"
#include "reports/picture.h"

namespace sluice {
namespace {

/// The exit through which most rock left, or water where there is no rock.
const RunManifest::ExitSummary* main_exit(const RunManifest& m) {
  const auto amount = [](const RunManifest::ExitSummary& e) {
    return e.rock_kg.value_or(e.rock_kg_s.value_or(0)) * 1e6 + e.water_kg.value_or(e.water_kg_s.value_or(0));
  };
  const auto most = std::max_element(m.exits.begin(), m.exits.end(),
                                     [&](const auto& a, const auto& b) { return amount(a) < amount(b); });
  return most == m.exits.end() ? nullptr : &*most;
}

std::string percent(std::optional<double> fraction) {
  return fraction ? number(100 * *fraction, 3) : number(std::nan(""));
}

/// A steady average with its 95 % limits, "-" where there is none.
/// @param alone  the average as a run has it whose manifest knows no limits
std::string with_limits(const RunManifest::ExitSummary& exit, std::string_view figure,
                        std::optional<double> alone, double factor) {
  if (exit.averages && exit.averages->steady)
    for (const RunManifest::Figure& f : exit.averages->figures)
      if (f.name == figure) return number_with_limits(factor * f.value, factor * (f.high95 - f.value));
  return number(alone ? factor * *alone : std::nan(""));
}

std::string tags(const std::vector<std::string>& names, const char* style) {
  std::string out = fmt::format("<div class=\"tags {}\">", style);
  for (const std::string& name : names) out += "<span>" + html(name) + "</span>";
  return out + "</div>";
}

std::string flow_cards(const RunManifest& m, const RunManifest::ExitSummary& exit) {
  std::string out;
  const std::string at = "<br>through " + html(exit.name);
  const auto flow = [&](const char* what, std::optional<double> kg_s, std::optional<double> kg) {
    if (kg_s) return card(number(t_h(*kg_s)), "t/h", what + at + ", steady mean");
    if (kg) return card(number(*kg / 1000), "t", what + at + " so far (not yet steady)");
    return std::string();
  };
  if (m.budgets.rock) out += flow("rock", exit.rock_kg_s, exit.rock_kg);
  if (m.budgets.water) out += flow("water with its fines", exit.water_kg_s, exit.water_kg);
  if (exit.rock_cov_across_width)
    out += card(number(*exit.rock_cov_across_width, 2), "",
                "unevenness of rock across the width<br>(standard deviation over mean; 0 = even)");
  if (exit.water_cov_across_width)
    out += card(number(*exit.water_cov_across_width, 2), "", "unevenness of water across the width");
  if (exit.water_m3_per_t) out += card(number(*exit.water_m3_per_t), "m\u00b3/t", "water per tonne of rock");
  if (exit.dry_rock_fraction) out += card(percent(exit.dry_rock_fraction), "%", "of the rock left unwetted");
  return out;
}

const char* picture_caption(const RunResults& run) {
  if (run.view->rocks && run.view->water)
    return "Rocks in their real shapes, water coloured by its speed, walls as glass.";
  if (run.view->water) return "Water coloured by its speed, walls as glass.";
  return "Rocks in their real shapes, coloured by their speed, walls as glass.";
}

std::string speed_bar(const RunResults& run, double fastest) {
  const char* what = run.view->water ? "speed of water" : "speed of rock";
  return fmt::format(
      "<div class=\"scale\"><span>{}: 0</span><i style=\"background:linear-gradient(90deg,{})\"></i>"
      "<span>{} m/s and more</span></div>",
      what, speed_gradient_css(), number(fastest, 2));
}

}  // namespace

PageSection summary_section(const RunResults& run) {
  const RunManifest& m = run.manifest;
  std::string body;
  if (m.failure)
    body += fmt::format(
        "<div class=\"failure\"><b>The run failed</b> in {} at {} s: {}<br>"
        "The results below are those up to then.</div>",
        html(m.failure->stage), number(m.failure->time_s, 5), html(m.failure->message));
  if (m.outcome == Outcome::interrupted)
    body +=
        "<p class=\"note\">The run was interrupted; <code>sluice run --resume</code> goes on from its last "
        "saved state. The results below are those up to then.</p>";
  if (m.outcome == Outcome::running) body += "<p class=\"note\">The run is still going on.</p>";
  body += "<div class=\"cards\">";
  const double time = m.time.simulated_s;
  if (m.budgets.rock && time > 0 && m.budgets.rock->requested_kg > 0)
    body += card(number(t_h(m.budgets.rock->entered_kg / time)), "t/h",
                 fmt::format("rock fed, mean<br>({} t/h asked for)",
                             number(t_h(m.budgets.rock->requested_kg / time))));
  if (m.budgets.water && time > 0 && m.budgets.water->requested_kg > 0)
    body += card(number(t_h(m.budgets.water->entered_kg / time)), "t/h",
                 fmt::format("water with its fines let in, mean<br>({} t/h asked for)",
                             number(t_h(m.budgets.water->requested_kg / time))));
  if (const auto* exit = main_exit(m)) body += flow_cards(m, *exit);
  if (m.counts.rocks)
    body += card(count(static_cast<double>(*m.counts.rocks)), "", "rocks inside at the end");
  if (m.counts.water_points)
    body += card(count(static_cast<double>(*m.counts.water_points)), "", "water points inside at the end");
  body += "</div>";
  if (!m.warnings.empty())
    body += fmt::format("<p><a href=\"#trust\">{} warning{}: read before using the numbers</a></p>",
                        m.warnings.size(), m.warnings.size() == 1 ? "" : "s");
  body += "<h3>In this run</h3>" + tags(m.parts.present, "in");
  if (!m.parts.left_out.empty()) body += "<h3>Left out</h3>" + tags(m.parts.left_out, "out");
  return {"summary", "Key results", body};
}

PageSection picture_section(const RunResults& run) {
  PageSection section{"pictures", "Pictures", ""};
  if (!run.view) return section;
  const View& view = *run.view;
  const SpeedScale scale = speed_scale(view);
  const SceneFrame frame = scene_frame(view);
  const PictureSize large, small{800, 600, 2};
  const auto figure = [&](const Camera& camera, const PictureSize& size, const std::string& caption) {
    const std::string png = png_bytes(draw_picture(view, camera, scale, size));
    return "<figure>" + inline_picture(png, caption) + "<figcaption>" + caption + "</figcaption></figure>";
  };
  section.body = fmt::format("<p class=\"note\">The last state, at t = {} s. {}</p>", number(view.time, 4),
                             picture_caption(run)) +
                 "<div class=\"pictures\">" + figure(overview_camera(frame, large), large, "Overview") +
                 figure(side_camera(frame, small), small,
                        fmt::format("From the side, to scale: the picture is {} m high",
                                    number(side_camera(frame, small).view_height, 3))) +
                 figure(exit_camera(frame, small), small, "From the exit, against the flow") + "</div>" +
                 speed_bar(run, scale.fastest);
  return section;
}

PageSection view_section(const RunResults& run) {
  PageSection section{"view3d", "3D view", ""};
  if (!run.view) return section;
  std::string note =
      fmt::format("The last state, at t = {} s. Drag to turn, wheel to zoom, right button to move.",
                  number(run.view->time, 4));
  if (const auto& water = run.view->water; water && water->stride > 1)
    note += fmt::format(" To keep the page small, {} of {} water points are shown (one in {}).",
                        count(static_cast<double>(water->count())), count(static_cast<double>(water->total)),
                        water->stride);
  const double fastest = speed_scale(*run.view).fastest;
  section.body =
      fmt::format(
          "<p class=\"note\">{}</p><div class=\"viewer\"><div id=\"scene\" data-fastest=\"{}\"></div>"
          "<div id=\"scene-controls\"></div></div>",
          note, fastest) +
      speed_bar(run, fastest);
  return section;
}

PageSection exit_section(const RunResults& run) {
  PageSection section{"exits", "Exits", ""};
  const RunManifest& m = run.manifest;
  if (m.exits.empty() && !run.exits) return section;
  section.body =
      "<p class=\"note\">Where rock and water leave across the width of each exit. Whiskers are 95 % "
      "confidence limits of the mean. Averages start where the flow has become steady; where it has not, "
      "the numbers are missing and the warnings say why.</p>";
  std::vector<std::vector<std::string>> rows;
  std::string not_steady;
  for (const auto& e : m.exits) {
    rows.push_back({html(e.name), with_limits(e, "rock_kg_s", e.rock_kg_s, 3.6),
                    with_limits(e, "water_kg_s", e.water_kg_s, 3.6),
                    with_limits(e, "water_m3_per_t", e.water_m3_per_t, 1),
                    with_limits(e, "rock_cov_across_width", e.rock_cov_across_width, 1),
                    with_limits(e, "rock_cov_corrected", e.rock_cov_corrected, 1),
                    with_limits(e, "water_cov_across_width", e.water_cov_across_width, 1),
                    with_limits(e, "water_to_rock_cov", e.water_to_rock_cov, 1),
                    with_limits(e, "dry_rock_fraction", e.dry_rock_fraction, 100),
                    with_limits(e, "rock_size_p80_m", e.rock_size_p80_m, 1000),
                    with_limits(e, "rock_speed_m_s", std::nullopt, 1), number(e.steady_from_s)});
    if (e.averages && !e.averages->steady)
      not_steady += "<li>" + html(e.name) + ": " + html(e.averages->reason) + "</li>";
  }
  if (!rows.empty())
    section.body +=
        html_table({"exit", "rock<br>t/h", "water with fines<br>t/h", "water per rock<br>m\u00b3/t",
                    "CoV of rock<br>across width", "CoV of rock<br>less shot noise",
                    "CoV of water<br>across width", "CoV of water<br>to rock", "rock left dry<br>%",
                    "P80 of rock<br>mm", "speed of rock<br>m/s", "steady from<br>s"},
                   rows);
  if (!not_steady.empty())
    section.body += "<p>No steady averages, and why:</p><ul class=\"warnings\">" + not_steady + "</ul>";
  if (!run.exits) return section;
  for (const ExitDistribution& exit : exit_distributions(*run.exits)) {
    std::string charts;
    for (const ExitQuantity& q : exit_quantities()) {
      ChartSeries series{q.title, {}, exit_values(*run.exits, exit, q.column, q.factor, q.per), {}, {}};
      if (std::none_of(series.y.begin(), series.y.end(), [](double y) { return std::isfinite(y); })) continue;
      series.low = exit_values(*run.exits, exit, std::string(q.column) + "_low95", q.factor, q.per);
      series.high = exit_values(*run.exits, exit, std::string(q.column) + "_high95", q.factor, q.per);
      charts += bin_chart({q.title, "across the width, m", q.unit}, exit.edges, {series});
    }
    if (!charts.empty())
      section.body += "<h3>" + html(exit.exit) + "</h3><div class=\"charts\">" + charts + "</div>";
  }
  return section;
}

PageSection mixing_section(const RunResults& run) {
  PageSection section{"mixing", "Mixing", ""};
  if (!run.mixing || run.mixing->rows.empty()) return section;
  const std::vector<std::string> zones = run.mixing->texts("zone");
  const std::vector<double> times = run.mixing->numbers("time_s");
  struct Index {
    const char* column;
    const char* title;
  };
  std::string charts;
  for (const Index& index : {Index{"water_rock_lacey", "Lacey index of water and rock (0 apart, 1 mixed)"},
                             Index{"water_share_rsd", "Unevenness of the water share (RSD, 0 = even)"},
                             Index{"wetted_rock_fraction", "Share of the rock that is wetted"}}) {
    const std::vector<double> values = run.mixing->numbers(index.column);
    std::vector<ChartSeries> series;
    for (std::size_t i = 0; i < values.size() && i < zones.size() && i < times.size(); ++i) {
      auto found =
          std::find_if(series.begin(), series.end(), [&](const auto& s) { return s.name == zones[i]; });
      if (found == series.end()) found = series.insert(series.end(), ChartSeries{zones[i], {}, {}, {}, {}});
      found->x.push_back(times[i]);
      found->y.push_back(values[i]);
    }
    if (std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
      charts += line_chart({index.title, "time, s", ""}, series);
  }
  if (charts.empty()) return section;
  section.body =
      "<p class=\"note\">How well water and rock are mixed on their way through, from the contents of cells. "
      "There is no Lacey index where cells are too small for the grains in them.</p><div class=\"charts\">" +
      charts + "</div>";
  return section;
}

PageSection wall_section(const RunResults& run) {
  PageSection section{"walls", "Walls", ""};
  if (!run.walls || run.walls->rows.empty()) return section;
  const std::vector<std::string> names = run.walls->texts("wall");
  const auto column = [&](const char* name) {
    std::vector<double> values = run.walls->numbers(name);
    values.resize(names.size(), std::nan(""));
    return values;
  };
  const auto size = [&](const std::string& phase, std::size_t i) {
    const auto at = [&](const char* axis) {
      const std::vector<double> v = run.walls->numbers(phase + "_mean_force_" + axis + "_N");
      return i < v.size() ? v[i] : std::nan("");
    };
    return std::hypot(at("x"), at("y"), at("z"));
  };
  const std::vector<double> area = column("area_m2"), time = column("time_s"),
                            slide = column("rock_sliding_energy_J"), hit = column("rock_impact_energy_J");
  double most = 0;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::isfinite(slide[i] + hit[i]) && time[i] > 0) most = std::max(most, (slide[i] + hit[i]) / time[i]);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double power = (slide[i] + hit[i]) / time[i];
    const std::string bar =
        std::isfinite(power) && most > 0
            ? fmt::format("<span class=\"bar\" style=\"width:{:.0f}px\"></span>", 90 * power / most)
            : "";
    rows.push_back({html(names[i]), number(area[i]), number(size("rock", i)), number(size("water", i)),
                    number(slide[i] / time[i]), number(hit[i] / time[i]), number(power / area[i]) + bar});
  }
  section.body =
      "<p class=\"note\">Mean over the run. Sliding work and impact work of rock are what wear follows; "
      "the bar compares walls.</p>" +
      html_table({"wall", "area<br>m\u00b2", "force of rock<br>N", "force of water<br>N",
                  "sliding work of rock<br>W", "impact work of rock<br>W", "both per area<br>W/m\u00b2"},
                 rows);
  return section;
}

}  // namespace sluice
