#pragma once
/// What left through an exit, across its width, over a window of time.

#include <string>
#include <vector>

#include "analysis/confidence.h"
#include "analysis/evenness.h"
#include "analysis/exits.h"

namespace sluice {

/// Stretch of simulated time [s]; whole slots of the tally inside it count.
struct TimeWindow {
  double from = 0;
  double to = 0;
};

/// One bin, or the whole exit. NaN where nothing left that the figure could be about. Limits come from
/// batches of whole slots: of means as they are, of ratios and quantiles by the jackknife.
struct ExitFigures {
  double from = 0, to = 0;         ///< along the width [m]
  double rock_count = 0;           ///< rocks in the window
  Estimate rock_kg_s, water_kg_s;  ///< water with its fines
  Estimate fines_kg_s, dry_rock_kg_s;
  Estimate rock_speed, water_speed;  ///< mass-weighted [m/s]
  Estimate energy_per_rock;          ///< mean kinetic energy [J]
  Estimate rock_power;               ///< kinetic energy that leaves in a second [W]
  Estimate size_mean, p50, p80;      ///< of the rock, by mass [m]
  Estimate residence;                ///< of the rock, mass-weighted [s]
  Estimate m3_per_tonne;             ///< clear water over rock
  Estimate dry_share;                ///< of the rock's mass
};

struct ExitDistribution {
  TimeWindow window;  ///< the slots that counted [s]
  std::vector<ExitFigures> bins;
  ExitFigures all;
  Evenness rock, water, water_to_rock;
};

/// @param water_density  of the clear water [kg/m3]
ExitDistribution exit_distribution(const ExitTally& tally, TimeWindow window, double water_density);

/// Mass per slot of one phase over all bins, for every slot up to `until` [kg]; slots without any count 0.
std::vector<double> rock_series(const ExitTally& tally, double until);
std::vector<double> water_series(const ExitTally& tally, double until);

/// Mean exit rate of rock over the window, all tallies together, over the feed rate.
double reached_fraction(const std::vector<ExitTally>& tallies, double feed_kg_s, TimeWindow window);

}  // namespace sluice
