#include "base/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sluice {

double mean(const std::vector<double>& x) {
  double sum = 0;
  for (double v : x) sum += v;
  return x.empty() ? 0.0 : sum / static_cast<double>(x.size());
}

double variance(const std::vector<double>& x) {
  if (x.size() < 2) return 0.0;
  const double m = mean(x);
  double sum = 0;
  for (double v : x) sum += (v - m) * (v - m);
  return sum / static_cast<double>(x.size() - 1);
}

double quantile(std::vector<double> x, double q) {
  if (x.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(x.begin(), x.end());
  const double place = q * static_cast<double>(x.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, x.size() - 1);
  return x[below] + (place - static_cast<double>(below)) * (x[above] - x[below]);
}

void Histogram::add(double x, double weight) {
  if (counts_.empty()) return;
  const double place = (x - low_) / (high_ - low_) * static_cast<double>(counts_.size());
  const double last = static_cast<double>(counts_.size()) - 1.0;
  counts_[static_cast<std::size_t>(std::clamp(place, 0.0, last))] += weight;
}

double Histogram::total() const {
  double sum = 0;
  for (double c : counts_) sum += c;
  return sum;
}

double Histogram::quantile(double q) const {
  const double wanted = q * total();
  const double width = (high_ - low_) / static_cast<double>(std::max<std::size_t>(1, counts_.size()));
  double sum = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (counts_[i] > 0 && sum + counts_[i] >= wanted)
      return low_ + width * (static_cast<double>(i) + (wanted - sum) / counts_[i]);
    sum += counts_[i];
  }
  return low_;
}

}  // namespace sluice
