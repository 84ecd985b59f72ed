#pragma once
/// What a run writes while it goes: series.csv, frames, checkpoints.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "output/checkpoint.h"
#include "output/frames.h"
#include "output/run_folder.h"
#include "output/series.h"
#include "processes/process_config.h"
#include "simulation/simulation.h"

namespace sluice {

class Recorder {
 public:
  /// @param resume_time  rows and frames later than this are dropped; without it the files start anew
  Recorder(const ProcessConfig& config, const RunFolder& folder, const Simulation& simulation,
           std::optional<double> resume_time);

  /// After every step: writes what is due.
  void after_step(const Simulation& simulation);
  void write_frame(const Simulation& simulation);
  /// True once a checkpoint interval has passed since the last `checkpoint_written`.
  bool checkpoint_due(const Simulation& simulation) const;

  void exchange(StateArchive& archive);

 private:
  void append_row(const Simulation& simulation);

  OutputConfig config_;
  Vec3 gravity_;
  std::unique_ptr<FrameWriter> frames_;
  std::unique_ptr<SeriesWriter> series_;
  std::vector<std::string> columns_;
  std::vector<double> last_totals_;  ///< of the quantities whose rates the series holds [kg]
  double last_row_ = 0;              ///< [s]
};

/// True in the step in which a multiple of `interval` falls.
bool falls_in_step(const Simulation& simulation, double interval);

}  // namespace sluice
