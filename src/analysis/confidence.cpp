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

Batches batches_of(std::size_t values) {
  const std::size_t count = std::min(most_batches, values);
  if (count < fewest_batches) return {values, 0, 0};
  const std::size_t length = values / count;
  return {values - count * length, length, count};
}

Estimate replicate_mean(const std::vector<double>& repetitions) {
  if (repetitions.empty()) return {not_known, not_known};
  Estimate estimate{mean(repetitions), not_known};
  const auto n = static_cast<double>(repetitions.size());
  if (repetitions.size() >= fewest_batches)
    estimate.half_width = student_t_975(n - 1) * std::sqrt(variance(repetitions) / n);
  return estimate;
}

Estimate batch_mean(const std::vector<double>& series) {
  if (series.empty()) return {not_known, not_known};
  const Batches batches = batches_of(series.size());
  std::vector<double> means;
  for (std::size_t b = 0; b < batches.count; ++b) {
    double sum = 0;
    for (std::size_t i = 0; i < batches.length; ++i) sum += series[batches.first + b * batches.length + i];
    means.push_back(sum / static_cast<double>(batches.length));
  }
  return {mean(series), replicate_mean(means).half_width};
}

double jackknife_half_width(const std::vector<double>& without) {
  if (without.size() < fewest_batches) return not_known;
  const auto n = static_cast<double>(without.size());
  // variance() divides by n - 1; the jackknife's error is (n - 1) / n of the sum of squares.
  return student_t_975(n - 1) * (n - 1) * std::sqrt(variance(without) / n);
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
