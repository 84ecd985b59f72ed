#pragma once
/// Sizes of rocks by mass, with the DEM cut-off below which feed is fines.
///
/// The cumulative curve is straight between its points, either over the size or over its logarithm; the
/// number of rocks goes as mass over size^3, which both cases integrate and invert in closed form, so that
/// sizes are drawn exactly (no table, no rejection).

#include <optional>
#include <vector>

#include "base/random.h"
#include "base/schema.h"

namespace sluice {

/// One sieve: what share of the mass passes it.
struct SizePoint {
  double size = 0;     ///< passing size [m]
  double passing = 0;  ///< mass share below it, 0 to 1
  void keys(Schema& s);
};

enum class SizeCurve {
  points,         ///< measured points of the cumulative curve
  rosin_rammler,  ///< passing = 1 - exp(-(size / d63)^spread)
  single,         ///< all of one size
};
enum class SizeInterpolation { log_linear, linear };

/// Keys under `sizes:` of a feed or a fill.
struct SizeDistributionConfig {
  SizeCurve curve = SizeCurve::points;
  std::vector<SizePoint> points;  ///< ascending
  SizeInterpolation interpolation = SizeInterpolation::log_linear;
  double d63 = 0;                  ///< size that 63.2 % passes [m]
  double spread = 0;               ///< exponent of Rosin and Rammler
  std::optional<double> top_size;  ///< Rosin-Rammler: largest rock; the curve is cut and scaled there [m]
  double size = 0;                 ///< of every rock, where `curve: single` [m]
  double cutoff = 0;               ///< rocks are made from this size up; what is finer is fines [m]
  Location where;
  void keys(Schema& s);
};

class SizeDistribution {
 public:
  /// @throws InputError where the configuration is not a distribution
  explicit SizeDistribution(const SizeDistributionConfig& config);

  double passing(double size) const;                         ///< cumulative mass share of the whole feed
  double size_at(double passing) const;                      ///< its inverse [m]; P80 is size_at(0.8)
  double fines_fraction() const { return fines_fraction_; }  ///< mass share below the cut-off
  double smallest() const { return smallest_; }              ///< rock [m]
  double largest() const { return largest_; }                ///< rock [m]
  /// Mean of size^3 over the rocks by number [m3]: mean mass = density x shape volume x this.
  double mean_cube() const { return mean_cube_; }
  /// Size of one rock [m], by number.
  double draw(Random& random) const;

 private:
  struct Segment {
    double lo = 0, hi = 0;  ///< sizes [m]
    double number = 0;      ///< rocks per unit of mass (up to a common factor), cumulative to its end
  };
  void add_segment(double lo, double hi, double mass);

  SizeInterpolation interpolation_;
  std::vector<SizePoint> curve_;   ///< whole feed
  std::vector<Segment> segments_;  ///< rocks only
  double fines_fraction_ = 0, smallest_ = 0, largest_ = 0, mean_cube_ = 0;
};

}  // namespace sluice
