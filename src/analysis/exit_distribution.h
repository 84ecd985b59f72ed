#pragma once
/// What left through an exit, across its width, over a window of time.

#include <string>
#include <vector>

#include "analysis/confidence.h"
#include "analysis/exits.h"

namespace sluice {

/// Stretch of simulated time [s]; whole slots of the tally inside it count.
struct TimeWindow {
  double from = 0;
  double to = 0;
};

/// One bin, or the whole exit. NaN where nothing left that the figure could be about.
struct ExitFigures {
  double from = 0, to = 0;         ///< along the width [m]
  Estimate rock_kg_s, water_kg_s;  ///< water with its fines
  double fines_kg_s = 0;
  double rock_count = 0;                   ///< rocks in the window
  double rock_speed = 0, water_speed = 0;  ///< mass-weighted [m/s]
  double energy_per_rock = 0;              ///< mean kinetic energy [J]
  double size_mean = 0, p50 = 0, p80 = 0;  ///< of the rock, by mass [m]
  double residence = 0;                    ///< of the rock, mass-weighted [s]
  double m3_per_tonne = 0;                 ///< clear water over rock
  double dry_share = 0;                    ///< of the rock's mass
};

/// Evenness over the bins: standard deviation over mean.
///
/// Few, large particles make bins differ by chance: floor^2 = (sum m^2 / sum m) / (mass per bin), the
/// coefficient of variation of a compound Poisson count. corrected^2 = raw^2 - floor^2, at least 0.
struct Evenness {
  double raw = 0, floor = 0, corrected = 0;
};

struct ExitDistribution {
  TimeWindow window;  ///< the slots that counted [s]
  std::vector<ExitFigures> bins;
  ExitFigures all;
  Evenness rock, water;
  /// Of the water-to-rock ratio, each bin weighted by its rock so that bins with hardly any rock do not
  /// decide; floor: the ratio's two counts taken as independent.
  Evenness water_to_rock;
};

/// @param water_density  of the clear water [kg/m3]
ExitDistribution exit_distribution(const ExitTally& tally, TimeWindow window, double water_density);

/// Evenness of a mass per bin; `squares` = sum of the particles' squared masses per bin.
Evenness evenness(const std::vector<double>& masses, const std::vector<double>& squares);

/// Mass per slot of one phase over all bins, for every slot up to `until` [kg]; slots without any count 0.
std::vector<double> rock_series(const ExitTally& tally, double until);
std::vector<double> water_series(const ExitTally& tally, double until);

/// Mean exit rate of rock over the window, all tallies together, over the feed rate.
double reached_fraction(const std::vector<ExitTally>& tallies, double feed_kg_s, TimeWindow window);

}  // namespace sluice
