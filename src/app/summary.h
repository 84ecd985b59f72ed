#pragma once
/// What a run says about itself: run.json, exits.csv, walls.csv, and the marks in its pictures.

#include <optional>
#include <string>
#include <vector>

#include "app/process_source.h"
#include "output/run_folder.h"
#include "output/run_manifest.h"
#include "output/view.h"
#include "simulation/simulation.h"

namespace sluice {

/// What a summary is made from.
struct RunState {
  const ProcessSource& source;
  const Simulation& simulation;
  double planned = 0;       ///< end asked for [s]
  double rock_rate = 0;     ///< that the feeds ask for, fines apart [kg/s]
  double wall_seconds = 0;  ///< of run time so far
  const std::vector<std::string>& warnings;
};

RunManifest make_manifest(const RunState& run, Outcome outcome,
                          const std::optional<RunManifest::Failure>& failure);

/// run.json and the tables.
void write_summary(const RunFolder& folder, const RunState& run, Outcome outcome,
                   const std::optional<RunManifest::Failure>& failure);

/// Name of the processor; "unknown" where the system does not say.
std::string processor_name();

/// Exits and emitters as outlines.
std::vector<ViewMark> view_marks(const ProcessConfig& config);

}  // namespace sluice
