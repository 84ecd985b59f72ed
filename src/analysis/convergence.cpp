#include "analysis/convergence.h"

#include <algorithm>
#include <cmath>

namespace sluice {

namespace {

constexpr double resolved_times = 3;
/// A bound on a change tells something where it is at most this share of the value.
constexpr double telling_share = 0.25;
constexpr double safety = 1.25;  // Roache (1994), three grids
constexpr double lowest_order = 0.5, highest_order = 3, order_of_schemes = 2;

/// Size of a cell, or what stands for it.
double cell_of(double setting, bool grows) {
  return grows ? 1 / setting : setting;
}

/// Celik et al. (2008), eq. 3: p = |ln|e32 / e21| + q(p)| / ln r21 by fixed-point iteration.
double observed_order(double e32, double e21, double r32, double r21) {
  double p = std::log(std::abs(e32 / e21)) / std::log(r21);
  for (int i = 0; i < 100; ++i) {
    const double q = std::log((std::pow(r21, p) - 1) / (std::pow(r32, p) - 1));
    const double next = (std::log(std::abs(e32 / e21)) + q) / std::log(r21);
    if (!std::isfinite(next)) return next;
    if (std::abs(next - p) < 1e-12) break;
    p = next;
  }
  return p;
}

}  // namespace

const char* word_of(ChangeVerdict verdict) {
  switch (verdict) {
    case ChangeVerdict::resolved:
      return "resolved";
    case ChangeVerdict::changed:
      return "changed";
    case ChangeVerdict::bounded:
      return "bounded";
    case ChangeVerdict::too_short:
      return "too_short";
    case ChangeVerdict::unknown:
      return "unknown";
  }
  return "";
}

Change change_between(const LadderPoint& coarse, const LadderPoint& fine) {
  Change c{fine.value - coarse.value, std::hypot(coarse.half_width, fine.half_width), ChangeVerdict::unknown};
  if (!std::isfinite(c.value) || !std::isfinite(c.half_width)) return c;
  const double change = std::abs(c.value);
  if (change > 0 && resolved_times * c.half_width < change)
    c.verdict = ChangeVerdict::resolved;
  else if (change > c.half_width)
    c.verdict = ChangeVerdict::changed;
  else
    c.verdict = change + c.half_width <= telling_share * std::abs(fine.value) ? ChangeVerdict::bounded
                                                                              : ChangeVerdict::too_short;
  return c;
}

std::optional<Extrapolation> extrapolate(const std::vector<LadderPoint>& points) {
  if (points.size() < 3) return std::nullopt;
  const LadderPoint &p3 = points[points.size() - 3], &p2 = points[points.size() - 2], &p1 = points.back();
  if (change_between(p3, p2).verdict != ChangeVerdict::resolved ||
      change_between(p2, p1).verdict != ChangeVerdict::resolved)
    return std::nullopt;
  const bool grows = p1.setting > p2.setting;
  const double h3 = cell_of(p3.setting, grows), h2 = cell_of(p2.setting, grows),
               h1 = cell_of(p1.setting, grows);
  if (!(h1 > 0 && h2 > h1 && h3 > h2)) return std::nullopt;
  const double e32 = p3.value - p2.value, e21 = p2.value - p1.value;
  if (e32 * e21 <= 0) return std::nullopt;
  const double r21 = h2 / h1;
  const double p = observed_order(e32, e21, h3 / h2, r21);
  if (!(p >= lowest_order && p <= highest_order)) return std::nullopt;
  const double gain = std::pow(r21, std::min(p, order_of_schemes)) - 1;
  return Extrapolation{p, p1.value - e21 / gain, safety * std::abs(e21) / gain};
}

}  // namespace sluice
