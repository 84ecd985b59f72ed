#pragma once
/// The results of a run that are worth comparing with another's, each under a stable name:
///
///   deck_end.water_cov_across_width   an exit's average (run.json, exits.NAME.averages)
///   cascade_lacey                     average of a series column over the same time: mixing, gauges, hold-up
///   wall.ledge_1.rock_force_N         mean over the whole run (walls.csv); has no limits
///   overlap.mean_percent_of_radius    over the whole run

#include <limits>
#include <string>
#include <vector>

#include "output/run_folder.h"

namespace sluice {

struct KeyResult {
  std::string name;
  std::string what;        ///< in words: "deck_end: unevenness of water across the width (CoV)"
  std::string shown_unit;  ///< for people; empty = a plain number
  double factor = 1;       ///< from SI to that unit
  bool headline = false;   ///< one of the few that lead a page
  bool steady = false;     ///< an average over a time that is steady
  double value = std::numeric_limits<double>::quiet_NaN();       ///< SI
  double half_width = std::numeric_limits<double>::quiet_NaN();  ///< of its 95 % limits, SI; NaN = none
  std::string reason;                                            ///< why it is not steady or has no limits
};

/// In the order above. @throws EnvironmentError, InputError  as the readers of the files
std::vector<KeyResult> key_results(const RunFolder& folder);

/// By name; null where the run has no such result.
const KeyResult* find_result(const std::vector<KeyResult>& results, const std::string& name);

}  // namespace sluice
