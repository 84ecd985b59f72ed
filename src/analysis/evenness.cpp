#include "analysis/evenness.h"

#include <algorithm>
#include <cmath>

#include "analysis/confidence.h"
#include "base/statistics.h"

namespace sluice {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

Evenness of_squares(double raw2, double floor2) {
  return {std::sqrt(raw2), std::sqrt(floor2), std::sqrt(std::max(0.0, raw2 - floor2))};
}

/// raw^2 - floor^2, which may be below 0.
double excess(const Evenness& e) {
  return e.raw * e.raw - e.floor * e.floor;
}

}  // namespace

double effective_mass(const std::vector<double>& masses, const std::vector<double>& squares) {
  double m = 0, m2 = 0;
  for (double x : masses) m += x;
  for (double x : squares) m2 += x;
  return m > 0 ? m2 / m : 0;
}

Evenness evenness(const std::vector<double>& masses, const std::vector<double>& squares) {
  const double per_bin = mean(masses);
  if (masses.size() < 2 || per_bin <= 0) return {not_known, not_known, not_known};
  return of_squares(variance(masses) / (per_bin * per_bin), effective_mass(masses, squares) / per_bin);
}

Evenness ratio_evenness(const TwoMasses& m) {
  double all_rock = 0, all_water = 0;
  std::size_t filled = 0;
  for (std::size_t b = 0; b < m.rock.size(); ++b) {
    if (m.rock[b] <= 0) continue;
    all_rock += m.rock[b];
    all_water += m.water[b];
    ++filled;
  }
  if (filled < 2 || all_water <= 0) return {not_known, not_known, not_known};
  const double overall = all_water / all_rock;
  double square = 0;
  for (std::size_t b = 0; b < m.rock.size(); ++b)
    if (m.rock[b] > 0) square += m.rock[b] * std::pow(m.water[b] / m.rock[b] / overall - 1, 2);
  const auto n = static_cast<double>(filled);
  return of_squares(square / all_rock * n / (n - 1), n * (m.rock_grain + m.water_grain / overall) / all_rock);
}

void set_limits(Evenness& figure, const std::vector<Evenness>& without) {
  std::vector<double> raw, squares;
  for (const Evenness& e : without) {
    raw.push_back(e.raw);
    squares.push_back(excess(e));
  }
  figure.raw_half_width = jackknife_half_width(raw);
  const double square = excess(figure), spread = jackknife_half_width(squares);
  if (!std::isfinite(square) || !std::isfinite(spread)) return;
  const double low = std::sqrt(std::max(0.0, square - spread)),
               high = std::sqrt(std::max(0.0, square + spread));
  figure.corrected_half_width = std::max(high - figure.corrected, figure.corrected - low);
}

}  // namespace sluice
