#include "inflow/size_distribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sluice {

namespace {

/// Points that stand for a Rosin-Rammler curve: 256 over its logarithm leave an interpolation error below
/// 1e-4 in passing for spreads up to 5.
constexpr int rosin_rammler_points = 256;
/// Where a Rosin-Rammler curve ends unless `top_size` says so.
constexpr double rosin_rammler_top = 0.999;

double rosin_rammler(double size, double d63, double spread) {
  return -std::expm1(-std::pow(size / d63, spread));
}

struct CurveProblem {
  const char* key;
  std::string problem, reason, suggestion;
};

/// What keeps the configuration from being a distribution, in reading order.
std::vector<CurveProblem> problems_of(const SizeDistributionConfig& c) {
  std::vector<CurveProblem> found;
  const auto add = [&](const char* key, std::string problem, std::string reason, std::string suggestion) {
    found.push_back({key, std::move(problem), std::move(reason), std::move(suggestion)});
  };
  double top = 0;
  if (c.curve == SizeCurve::points) {
    if (c.points.size() < 2) {
      add("points", fmt::format("has {} points", c.points.size()), "a curve needs at least two",
          "give sieve sizes with their passing, finest first");
      return found;
    }
    for (std::size_t i = 0; i < c.points.size(); ++i) {
      const SizePoint& p = c.points[i];
      if (!(p.size > 0) || !(p.passing >= 0 && p.passing <= 1))
        add("points", fmt::format("has size {} m with passing {}", p.size, p.passing),
            "sizes are above 0 and passing lies between 0 and 100 %", "correct the point");
      if (i > 0 && !(p.size > c.points[i - 1].size && p.passing >= c.points[i - 1].passing))
        add("points", fmt::format("falls from point {} to point {}", i, i + 1),
            "size and passing both grow along a cumulative curve", "sort the points, finest first");
    }
    if (c.points.back().passing != 1)
      add("points", fmt::format("ends at {} % passing", 100 * c.points.back().passing),
          "all of the feed passes the top size", "add the top size with 100 %");
    if (c.points.front().passing > 0 && c.cutoff < c.points.front().size)
      add("cutoff", "is below the finest point",
          fmt::format("the curve begins at {} % passing, so what is finer has no size",
                      100 * c.points.front().passing),
          "raise the cut-off to the finest point, or begin the curve at 0 %");
    top = c.points.back().size;
  } else if (c.curve == SizeCurve::rosin_rammler) {
    if (!(c.d63 > 0)) add("d63", "is missing", "curve: rosin_rammler needs it", "give a size above 0");
    if (!(c.spread > 0))
      add("spread", "is missing", "curve: rosin_rammler needs it", "give a number above 0");
    if (!(c.cutoff > 0))
      add("cutoff", "is missing", "a Rosin-Rammler curve has no finest rock", "give the cut-off size");
    if (!found.empty()) return found;
    top = c.top_size.value_or(c.d63 * std::pow(-std::log1p(-rosin_rammler_top), 1 / c.spread));
  } else {
    if (!(c.size > 0)) add("size", "is missing", "curve: single needs it", "give a size above 0");
    if (c.cutoff > c.size) add("cutoff", "is above the size", "no rock would be left", "lower the cut-off");
    return found;
  }
  if (found.empty() && c.cutoff >= top)
    add("cutoff", fmt::format("is {} m", c.cutoff),
        fmt::format("the largest rock has {} m, so that none would be left", top), "lower the cut-off");
  return found;
}

}  // namespace

void SizePoint::keys(Schema& s) {
  s.number("size", size,
           {.unit = "m", .required = true, .above = 0, .doc = "sieve opening", .example = "25 mm"});
  s.number("passing", passing,
           {.required = true,
            .at_least = 0,
            .at_most = 1,
            .doc = "share of the mass that passes it",
            .example = "80 %"});
}

void SizeDistributionConfig::keys(Schema& s) {
  where = s.here();
  s.choice("curve", curve,
           {{"points", SizeCurve::points},
            {"rosin_rammler", SizeCurve::rosin_rammler},
            {"single", SizeCurve::single}},
           {.doc = "how the sizes are given: measured points, Rosin-Rammler, or one size"});
  s.list("points", points,
         {.doc = "points of the cumulative curve by mass, finest first, up to 100 %",
          .applies = curve == SizeCurve::points,
          .applies_to = "curve: points"});
  s.choice("interpolation", interpolation,
           {{"log_linear", SizeInterpolation::log_linear}, {"linear", SizeInterpolation::linear}},
           {.doc = "the curve between points: straight over the logarithm of the size, or over the size",
            .applies = curve == SizeCurve::points,
            .applies_to = "curve: points"});
  const bool rr = curve == SizeCurve::rosin_rammler;
  s.number("d63", d63,
           {.unit = "m",
            .above = 0,
            .doc = "size that 63.2 % of the mass passes",
            .applies = rr,
            .applies_to = "curve: rosin_rammler"});
  s.number("spread", spread,
           {.above = 0,
            .doc = "exponent of Rosin and Rammler: small = wide",
            .applies = rr,
            .applies_to = "curve: rosin_rammler"});
  s.number("top_size", top_size,
           {.unit = "m",
            .above = 0,
            .doc = "largest rock; default: the size that 99.9 % passes",
            .applies = rr,
            .applies_to = "curve: rosin_rammler"});
  s.number("size", size,
           {.unit = "m",
            .above = 0,
            .doc = "size of every rock",
            .applies = curve == SizeCurve::single,
            .applies_to = "curve: single"});
  s.number("cutoff", cutoff,
           {.unit = "m",
            .at_least = 0,
            .doc = "DEM cut-off: rocks are made from this size up; what is finer is fines"});
  for (const CurveProblem& p : problems_of(*this)) s.problem(p.key, p.problem, p.reason, p.suggestion);
}

SizeDistribution::SizeDistribution(const SizeDistributionConfig& c) : interpolation_(c.interpolation) {
  std::vector<InputProblem> problems;
  for (const CurveProblem& p : problems_of(c))
    problems.push_back({c.where, p.key, p.problem, p.reason, p.suggestion});
  if (!problems.empty()) throw InputError(std::move(problems));

  if (c.curve == SizeCurve::single) {
    curve_ = {{c.size, 0}, {c.size, 1}};
    smallest_ = largest_ = c.size;
    mean_cube_ = c.size * c.size * c.size;
    return;
  }
  if (c.curve == SizeCurve::points) {
    curve_ = c.points;
  } else {
    interpolation_ = SizeInterpolation::log_linear;
    const double top = c.top_size.value_or(c.d63 * std::pow(-std::log1p(-rosin_rammler_top), 1 / c.spread));
    const double bottom = std::min(0.5 * c.cutoff, 1e-3 * top);
    const double scale = rosin_rammler(top, c.d63, c.spread);
    for (int i = 0; i < rosin_rammler_points; ++i) {
      const double size = bottom * std::pow(top / bottom, i / (rosin_rammler_points - 1.0));
      curve_.push_back({size, rosin_rammler(size, c.d63, c.spread) / scale});
    }
    curve_.back() = {top, 1};
  }

  // Rocks: the part of the curve above the cut-off.
  fines_fraction_ = c.cutoff > 0 ? passing(c.cutoff) : curve_.front().passing;
  for (std::size_t i = 1; i < curve_.size(); ++i) {
    const double lo = std::max(curve_[i - 1].size, c.cutoff);
    if (lo >= curve_[i].size) continue;
    const double mass = curve_[i].passing - std::max(curve_[i - 1].passing, passing(lo));
    if (mass > 0) add_segment(lo, curve_[i].size, mass);
  }
  smallest_ = segments_.front().lo;
  largest_ = segments_.back().hi;
  mean_cube_ = (1 - fines_fraction_) / segments_.back().number;
}

void SizeDistribution::add_segment(double lo, double hi, double mass) {
  // Rocks per mass: the integral of size^-3 over the segment's mass.
  const double number = interpolation_ == SizeInterpolation::log_linear
                            ? mass / std::log(hi / lo) * (std::pow(lo, -3) - std::pow(hi, -3)) / 3
                            : mass / (hi - lo) * (std::pow(lo, -2) - std::pow(hi, -2)) / 2;
  segments_.push_back({lo, hi, number + (segments_.empty() ? 0 : segments_.back().number)});
}

double SizeDistribution::passing(double size) const {
  if (size >= curve_.back().size) return 1;
  if (size <= curve_.front().size) return size == curve_.front().size ? curve_.front().passing : 0;
  const auto above = std::upper_bound(curve_.begin(), curve_.end(), size,
                                      [](double d, const SizePoint& p) { return d < p.size; });
  const SizePoint &a = *(above - 1), &b = *above;
  const double share = interpolation_ == SizeInterpolation::log_linear
                           ? std::log(size / a.size) / std::log(b.size / a.size)
                           : (size - a.size) / (b.size - a.size);
  return a.passing + share * (b.passing - a.passing);
}

double SizeDistribution::size_at(double passing) const {
  if (passing >= 1) return curve_.back().size;
  const auto above = std::upper_bound(curve_.begin(), curve_.end(), passing,
                                      [](double q, const SizePoint& p) { return q < p.passing; });
  if (above == curve_.begin()) return curve_.front().size;
  const SizePoint &a = *(above - 1), &b = *above;
  const double share = (passing - a.passing) / (b.passing - a.passing);
  return interpolation_ == SizeInterpolation::log_linear ? a.size * std::pow(b.size / a.size, share)
                                                         : a.size + share * (b.size - a.size);
}

double SizeDistribution::draw(Random& random) const {
  if (segments_.empty()) return largest_;
  const double wanted = random.uniform() * segments_.back().number;
  const auto at = std::upper_bound(segments_.begin(), segments_.end() - 1, wanted,
                                   [](double n, const Segment& s) { return n < s.number; });
  const double before = at == segments_.begin() ? 0 : (at - 1)->number;
  const double u = std::clamp((wanted - before) / (at->number - before), 0.0, 1.0);
  const double power = interpolation_ == SizeInterpolation::log_linear ? -3 : -2;
  const double lo = std::pow(at->lo, power), hi = std::pow(at->hi, power);
  return std::clamp(std::pow(lo - u * (lo - hi), 1 / power), at->lo, at->hi);
}

}  // namespace sluice
