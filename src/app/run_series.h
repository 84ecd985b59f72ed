#pragma once
/// Several runs one after another, each in a process of its own: one that breaks takes no other with it, and
/// the memory that each says it took is its own. What is finished is not run again; what was interrupted goes
/// on.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "base/errors.h"

namespace sluice {

/// One run of the series.
struct PlannedRun {
  std::string name;    ///< as it is told: "water.spacing = 20 mm"
  RunOptions options;  ///< `out` is given; `resume` is decided here
  Location place;      ///< where what it changes stands, for messages
};

/// Name of a folder that says the setting: "20 mm" -> "20-mm".
std::string folder_name(const std::string& setting);
/// The command line that makes this run alone.
std::string command_of(const RunOptions& options);

/// How far a planned run is.
enum class Standing {
  fresh,       ///< nothing is there, or nothing to go on from
  unfinished,  ///< its checkpoint goes on
  finished,
  failed,  ///< by this very program: it would fail again
};
/// @throws InputError  the folder holds a run of another process or other settings
Standing standing_of(const PlannedRun& run);

/// Runs one and returns its exit code.
using RunOne = std::function<int(const RunOptions&)>;
/// In a process of its own, with this program. Signals reach it.
int run_apart(const RunOptions& options);

/// Reads and builds each once before the first starts, so that what does not fit is told at once.
/// @throws InputError  placed where the change stands
void check_series(const std::vector<PlannedRun>& runs);
/// @return 0, 3 where a run failed numerically (the others are run all the same), 130 where it was
/// interrupted
/// @throws EnvironmentError  a run could not go on for reasons of the machine
int run_series(const std::vector<PlannedRun>& runs, const RunOne& run_one);

}  // namespace sluice
