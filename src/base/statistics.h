#pragma once
/// Small statistics with a fixed order of sums.

#include <cstddef>
#include <vector>

namespace sluice {

double mean(const std::vector<double>& x);
/// Unbiased variance; 0 for fewer than two values.
double variance(const std::vector<double>& x);
/// Quantile by linear interpolation, q in [0, 1]; x is sorted here. NaN for an empty list.
double quantile(std::vector<double> x, double q);

/// Histogram over fixed bins, kept as counts so that a run's percentiles need no list.
class Histogram {
 public:
  Histogram() = default;
  Histogram(double low, double high, std::size_t bins) : low_(low), high_(high), counts_(bins, 0.0) {}
  void add(double x, double weight = 1.0);
  double quantile(double q) const;  ///< within one bin width
  double total() const;
  std::vector<double>& counts() { return counts_; }

 private:
  double low_ = 0, high_ = 1;
  std::vector<double> counts_;
};

}  // namespace sluice
