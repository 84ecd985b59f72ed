#pragma once
/// How evenly something is spread over bins.

#include <limits>
#include <vector>

namespace sluice {

/// Standard deviation over mean of the bins.
///
/// Few, large particles make bins differ by chance: floor^2 = (sum m^2 / sum m) / (mass per bin), the
/// coefficient of variation of a compound Poisson count. corrected^2 = raw^2 - floor^2, at least 0.
struct Evenness {
  double raw = 0, floor = 0, corrected = 0;
  /// Half widths of the 95 % limits; NaN where there are none.
  double raw_half_width = std::numeric_limits<double>::quiet_NaN();
  double corrected_half_width = std::numeric_limits<double>::quiet_NaN();
};

/// Evenness of a mass per bin; `squares` = sum of the particles' squared masses per bin. NaN for one bin or
/// no mass.
Evenness evenness(const std::vector<double>& masses, const std::vector<double>& squares);

/// Mass of a typical particle as the mass sees it: sum m^2 / sum m.
double effective_mass(const std::vector<double>& masses, const std::vector<double>& squares);

/// Masses per bin of two kinds, and the effective mass of a particle of each [kg].
struct TwoMasses {
  const std::vector<double>&rock, &water;
  double rock_grain, water_grain;
};
/// Evenness of the water-to-rock ratio, each bin weighted by its rock so that bins with hardly any rock do
/// not decide; floor: the ratio's two counts taken as independent.
Evenness ratio_evenness(const TwoMasses& m);

/// Puts in the limits by the jackknife. Those of the corrected figure come from its square, which has no kink
/// at 0, and are the wider side.
/// @param without  the figures with each batch left out in turn
void set_limits(Evenness& figure, const std::vector<Evenness>& without);

}  // namespace sluice
