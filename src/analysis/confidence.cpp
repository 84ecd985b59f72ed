#include "analysis/confidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/statistics.h"

namespace sluice {

namespace {

constexpr std::size_t most_batches = 20, fewest_batches = 4;
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double student_t_975(double n) {
  const double z = 1.959963984540054;
  const double z2 = z * z;
  return z * (1 + (z2 + 1) / (4 * n) + (5 * z2 * z2 + 16 * z2 + 3) / (96 * n * n) +
              (3 * z2 * z2 * z2 + 19 * z2 * z2 + 17 * z2 - 15) / (384 * n * n * n));
}

Estimate batch_mean(const std::vector<double>& series) {
  if (series.empty()) return {not_known, not_known};
  Estimate estimate{mean(series), not_known};
  const std::size_t batches = std::min(most_batches, series.size());
  if (batches < fewest_batches) return estimate;
  const std::size_t length = series.size() / batches;
  const std::size_t first = series.size() - batches * length;
  std::vector<double> means;
  for (std::size_t b = 0; b < batches; ++b) {
    double sum = 0;
    for (std::size_t i = 0; i < length; ++i) sum += series[first + b * length + i];
    means.push_back(sum / static_cast<double>(length));
  }
  estimate.half_width = student_t_975(static_cast<double>(batches - 1)) *
                        std::sqrt(variance(means) / static_cast<double>(batches));
  return estimate;
}

double weighted_quantile(const std::vector<double>& values, const std::vector<double>& masses, double q) {
  if (values.empty()) return not_known;
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  double total = 0;
  for (double m : masses) total += m;
  const double wanted = q * total;
  double below = 0, last_middle = 0, last_value = values[order.front()];
  for (const std::size_t i : order) {
    const double middle = below + 0.5 * masses[i];
    if (middle >= wanted) {
      const double share = middle > last_middle ? (wanted - last_middle) / (middle - last_middle) : 1;
      return last_value + share * (values[i] - last_value);
    }
    below += masses[i];
    last_middle = middle;
    last_value = values[i];
  }
  return last_value;
}

}  // namespace sluice
