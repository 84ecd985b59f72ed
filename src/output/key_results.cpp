#include "output/key_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/confidence.h"
#include "analysis/steady_state.h"
#include "output/csv.h"
#include "output/run_manifest.h"

namespace sluice {

namespace {

struct FigureWords {
  const char* name;
  const char* words;
  const char* unit;
  double factor;
  bool headline;
};

constexpr std::array<FigureWords, 15> exit_figures = {
    {{"rock_kg_s", "rock", "t/h", 3.6, true},
     {"water_kg_s", "water with its fines", "t/h", 3.6, true},
     {"rock_cov_across_width", "unevenness of rock across the width (CoV)", "", 1, false},
     {"rock_cov_corrected", "unevenness of rock less shot noise (CoV)", "", 1, true},
     {"water_cov_across_width", "unevenness of water across the width (CoV)", "", 1, true},
     {"water_cov_corrected", "unevenness of water less shot noise (CoV)", "", 1, false},
     {"water_to_rock_cov", "unevenness of water to rock (CoV)", "", 1, true},
     {"water_m3_per_t", "water per rock", "m\u00b3/t", 1, true},
     {"dry_rock_fraction", "rock left dry", "%", 100, true},
     {"rock_size_p80_m", "P80 of rock", "mm", 1000, false},
     {"rock_speed_m_s", "speed of rock", "m/s", 1, true},
     {"water_speed_m_s", "speed of water", "m/s", 1, false},
     {"rock_energy_W", "kinetic energy of rock that leaves", "W", 1, false},
     {"rock_residence_s", "residence time of rock", "s", 1, false},
     {"fines_kg_s", "fines", "t/h", 3.6, false}}};

/// How the end of a series column's name is shown.
constexpr std::array<FigureWords, 11> column_endings = {
    {{"_lacey", "Lacey index (0 apart, 1 mixed)", "", 1, true},
     {"_rsd", "unevenness of the water share (RSD)", "", 1, true},
     {"_segregation", "segregation (1 apart, 0 mixed)", "", 1, false},
     {"_rock_kg", "rock inside", "kg", 1, true},
     {"_water_kg", "water inside", "kg", 1, true},
     {"_fines_kg", "fines inside", "kg", 1, false},
     {"_kinetic_J", "kinetic energy", "J", 1, false},
     {"_inside_kg", "inside", "kg", 1, false},
     {"_Pa", "", "kPa", 1e-3, true},
     {"_m", "", "m", 1, true},
     {"", "", "", 1, false}}};

/// Columns that count or follow from the exits.
bool is_compared(const std::string& column, const RunManifest& m) {
  for (const char* name : {"time_s", "rocks", "water_points", "rock_overlap_max_percent", "water_fastest_m_s",
                           "rock_in_kg_s", "water_in_kg_s"})
    if (column == name) return false;
  for (const auto& exit : m.exits)
    if (column == exit.name + "_rock_kg_s" || column == exit.name + "_water_kg_s") return false;
  return true;
}

void add_exits(std::vector<KeyResult>& results, const RunManifest& m) {
  for (const auto& exit : m.exits) {
    if (!exit.averages) continue;
    for (const FigureWords& words : exit_figures)
      for (const RunManifest::Figure& f : exit.averages->figures) {
        if (f.name != words.name) continue;
        KeyResult r;
        r.name = exit.name + "." + f.name;
        r.what = exit.name + ": " + words.words;
        r.shown_unit = words.unit;
        r.factor = words.factor;
        r.headline = words.headline;
        r.steady = exit.averages->steady;
        r.value = f.value;
        r.half_width = f.high95 - f.value;
        r.reason = exit.averages->reason;
        if (r.reason.empty() && std::isnan(r.value)) r.reason = "nothing left that it could be about";
        if (r.reason.empty() && std::isnan(r.half_width)) r.reason = "too few time slots for limits";
        results.push_back(std::move(r));
      }
  }
}

/// Over which time series columns are averaged: with the exits, from where all of them are steady.
struct AveragingTime {
  std::optional<double> steady_from;
  std::string reason;
};

AveragingTime averaging_time(const RunManifest& m) {
  AveragingTime t;
  for (const auto& exit : m.exits) {
    if (!exit.averages) continue;
    if (!exit.averages->steady) return {std::nullopt, exit.name + ": " + exit.averages->reason};
    t.steady_from = std::max(t.steady_from.value_or(0), exit.averages->from_s);
  }
  return t;
}

KeyResult series_result(const std::string& column, const std::vector<double>& time,
                        const std::vector<double>& values, AveragingTime when) {
  KeyResult r;
  const auto ending = std::find_if(column_endings.begin(), column_endings.end(),
                                   [&](const FigureWords& w) { return column.ends_with(w.name); });
  std::string name = column.substr(0, column.size() - std::string(ending->name).size());
  std::replace(name.begin(), name.end(), '_', ' ');
  r.name = column;
  r.what = *ending->words && !name.empty() ? name + ": " + ending->words : name + ending->words;
  r.shown_unit = ending->unit;
  r.factor = ending->factor;
  r.headline = ending->headline;
  if (time.empty()) {
    r.reason = "the run has no series";
    return r;
  }
  const bool own = !when.steady_from && when.reason.empty();  // no exits: the column speaks for itself
  const bool gaps = std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); });
  if (own && !gaps) {
    const double interval = time.back() / static_cast<double>(time.size());
    const SteadyState state = find_steady_state({{column, values}}, interval, 0);
    when = {state.from, state.reason};
  } else if (own) {
    when.reason = "has no value at times";
  }
  r.steady = when.steady_from.has_value();
  r.reason = when.reason;
  const double from = when.steady_from.value_or(0.5 * time.back());
  std::vector<double> window;
  bool whole = true;
  for (std::size_t i = 0; i < std::min(time.size(), values.size()); ++i) {
    if (time[i] < from) continue;
    if (std::isfinite(values[i]))
      window.push_back(values[i]);
    else
      whole = false;
  }
  const Estimate e = batch_mean(window);
  r.value = e.value;
  if (whole)
    r.half_width = e.half_width;
  else if (r.reason.empty())
    r.reason = "has no value at times";
  return r;
}

void add_walls(std::vector<KeyResult>& results, const CsvTable& walls) {
  const std::vector<std::string> names = walls.texts("wall");
  const std::vector<double> time = walls.numbers("time_s");
  const auto add = [&](std::size_t i, const char* name, const char* what, const char* unit, double value) {
    if (!std::isfinite(value)) return;
    KeyResult r;
    r.name = "wall." + names[i] + "." + name;
    r.what = "wall " + names[i] + ": " + what;
    r.shown_unit = unit;
    r.value = value;
    r.reason = "a mean over the whole run, without limits";
    results.push_back(std::move(r));
  };
  const auto force = [&](std::size_t i, const std::string& phase) {
    double square = 0;
    for (const char* axis : {"x", "y", "z"})
      square += std::pow(walls.numbers(phase + "_mean_force_" + axis + "_N").at(i), 2);
    return std::sqrt(square);
  };
  for (std::size_t i = 0; i < names.size(); ++i) {
    add(i, "rock_force_N", "force of rock", "N", force(i, "rock"));
    add(i, "water_force_N", "force of water", "N", force(i, "water"));
    if (!(time[i] > 0)) continue;
    add(i, "rock_sliding_W", "sliding work of rock", "W",
        walls.numbers("rock_sliding_energy_J")[i] / time[i]);
    add(i, "rock_impact_W", "impact work of rock", "W", walls.numbers("rock_impact_energy_J")[i] / time[i]);
  }
}

}  // namespace

std::vector<KeyResult> key_results(const RunFolder& folder) {
  const RunManifest m = read_manifest(folder.manifest());
  std::vector<KeyResult> results;
  add_exits(results, m);
  if (std::filesystem::exists(folder.series())) {
    const CsvTable series = read_csv(folder.series());
    const AveragingTime when = averaging_time(m);
    const std::vector<double> time = series.numbers("time_s");
    for (const std::string& column : series.columns)
      if (is_compared(column, m))
        results.push_back(series_result(column, time, series.numbers(column), when));
  }
  if (std::filesystem::exists(folder.walls())) add_walls(results, read_csv(folder.walls()));
  if (m.overlap) {
    KeyResult r;
    r.name = "overlap.mean_percent_of_radius";
    r.what = "mean overlap of rocks";
    r.shown_unit = "% of radius";
    r.value = m.overlap->mean_percent_of_radius;
    r.reason = "a mean over the whole run, without limits";
    results.push_back(r);
  }
  return results;
}

const KeyResult* find_result(const std::vector<KeyResult>& results, const std::string& name) {
  const auto found =
      std::find_if(results.begin(), results.end(), [&](const KeyResult& r) { return r.name == name; });
  return found == results.end() ? nullptr : &*found;
}

}  // namespace sluice
