#include "app/recorder.h"

#include <cmath>

namespace sluice {

namespace {

/// Masses whose rates of change the series shows: entered, then left by each exit; rock and water [kg].
std::vector<double> totals_of(const Parts& parts) {
  std::vector<double> totals;
  double rock = 0, water = 0;
  for (const auto& inflow : parts.inflows) {
    rock += inflow->rock().entered;
    water += inflow->water().entered;
  }
  if (parts.rocks) totals.push_back(rock);
  if (parts.water) totals.push_back(water);
  for (const ExitTally& tally : parts.exits->tallies()) {
    if (parts.rocks) totals.push_back(tally.rock_kg());
    if (parts.water) totals.push_back(tally.water_kg());
  }
  return totals;
}

std::vector<std::string> columns_of(const Parts& parts) {
  std::vector<std::string> columns{"time_s"};
  const auto add = [&](const std::string& name) { columns.push_back(name); };
  if (parts.rocks) add("rock_in_kg_s");
  if (parts.water) add("water_in_kg_s");
  for (const ExitTally& tally : parts.exits->tallies()) {
    if (parts.rocks) add(tally.config().name + "_rock_kg_s");
    if (parts.water) add(tally.config().name + "_water_kg_s");
  }
  if (parts.rocks)
    for (const char* name : {"rocks", "rock_inside_kg", "rock_kinetic_J", "rock_overlap_max_percent"})
      add(name);
  if (parts.water)
    for (const char* name : {"water_points", "water_inside_kg", "water_kinetic_J", "water_fastest_m_s"})
      add(name);
  for (const auto& probe : parts.probes)
    for (const std::string& column : probe->columns()) add(column);
  return columns;
}

double sum(const std::vector<double>& x) {
  double total = 0;
  for (double v : x) total += v;
  return total;
}

}  // namespace

bool falls_in_step(const Simulation& simulation, double interval) {
  const double dt = simulation.time_step().dt;
  const double now = std::floor(simulation.time() / interval + 1e-9);
  return now > std::floor((simulation.time() - dt) / interval + 1e-9);
}

Recorder::Recorder(const ProcessConfig& config, const RunFolder& folder, const Simulation& simulation,
                   std::optional<double> resume_time)
    : config_(config.output), gravity_(config.gravity), columns_(columns_of(simulation.parts())) {
  if (config_.frames_every > 0) {
    frames_ = std::make_unique<FrameWriter>(
        folder.frames(), config_.rock_surface ? RockSurface::tessellated : RockSurface::none, resume_time);
    if (!resume_time) frames_->write_walls(simulation.parts().walls->all());
  }
  series_ = std::make_unique<SeriesWriter>(folder.series(), columns_, resume_time);
  last_totals_ = totals_of(simulation.parts());
  last_row_ = simulation.time();
  if (!resume_time) write_frame(simulation);
}

void Recorder::after_step(const Simulation& simulation) {
  if (falls_in_step(simulation, config_.series_every)) append_row(simulation);
  if (frames_ && falls_in_step(simulation, config_.frames_every)) write_frame(simulation);
}

bool Recorder::checkpoint_due(const Simulation& simulation) const {
  return falls_in_step(simulation, config_.checkpoint_every);
}

void Recorder::write_frame(const Simulation& simulation) {
  if (!frames_) return;
  const SceneView view = simulation.view();
  frames_->write(take_snapshot(view.t, gravity_, view.rocks, view.water, *view.walls));
}

void Recorder::append_row(const Simulation& simulation) {
  const Parts& parts = simulation.parts();
  const std::vector<double> totals = totals_of(parts);
  const double elapsed = simulation.time() - last_row_;
  std::vector<double> row{simulation.time()};
  for (std::size_t i = 0; i < totals.size(); ++i)
    row.push_back(elapsed > 0 ? (totals[i] - last_totals_[i]) / elapsed : 0.0);
  if (parts.rocks) {
    row.push_back(static_cast<double>(parts.rocks->rocks().count()));
    row.push_back(sum(parts.rocks->rocks().mass));
    row.push_back(parts.rocks->energy().kinetic);
    row.push_back(parts.rocks->overlap_max());
  }
  if (parts.water) {
    row.push_back(static_cast<double>(parts.water->count()));
    row.push_back(parts.water->total_mass());
    row.push_back(parts.water->kinetic_energy());
    row.push_back(parts.water->largest_speed());
  }
  for (const auto& probe : parts.probes)
    for (double value : probe->values()) row.push_back(value);
  series_->append(row);
  last_totals_ = totals;
  last_row_ = simulation.time();
}

void Recorder::exchange(StateArchive& a) {
  a.values("last_totals", last_totals_);
  a.value("last_row", last_row_);
}

}  // namespace sluice
