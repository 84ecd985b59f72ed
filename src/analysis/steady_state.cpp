#include "analysis/steady_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/statistics.h"

namespace sluice {

namespace {

constexpr std::size_t mser_batch = 5;
constexpr double residence_times = 10, batches = 20, correlation_times = 5;
/// A trend: its slope is beyond chance (t of 20 batch means, 99 %) and moves the mean by more than 5 %.
constexpr double trend_t = 2.88, trend_share = 0.05;

/// Change over the whole series by its regression line over 20 batch means, if beyond chance; else 0.
double trend(const std::vector<double>& values) {
  const auto n = static_cast<std::size_t>(batches);
  const std::size_t length = values.size() / n;
  std::vector<double> means;
  for (std::size_t b = 0; b < n; ++b) {
    const auto first = values.end() - static_cast<std::ptrdiff_t>((n - b) * length);
    means.push_back(mean({first, first + static_cast<std::ptrdiff_t>(length)}));
  }
  const double middle = 0.5 * (batches - 1), level = mean(means);
  double sxx = 0, sxy = 0, syy = 0;
  for (std::size_t b = 0; b < n; ++b) {
    const double x = static_cast<double>(b) - middle;
    sxx += x * x;
    sxy += x * (means[b] - level);
    syy += (means[b] - level) * (means[b] - level);
  }
  const double slope = sxy / sxx;
  const double error = std::sqrt(std::max(0.0, syy - slope * sxy) / (batches - 2) / sxx);
  return std::abs(slope) > trend_t * error ? slope * batches : 0;
}

}  // namespace

std::size_t mser_cut(const std::vector<double>& values) {
  std::vector<double> b;
  for (std::size_t i = 0; i + mser_batch <= values.size(); i += mser_batch)
    b.push_back(mean({values.begin() + static_cast<std::ptrdiff_t>(i),
                      values.begin() + static_cast<std::ptrdiff_t>(i + mser_batch)}));
  // From the end: running sums give the mean and spread of every tail.
  double sum = 0, square = 0, best = std::numeric_limits<double>::infinity();
  const double shift = mean(b);
  std::size_t cut = 0;
  for (std::size_t k = b.size(); k-- > 0;) {
    const double x = b[k] - shift;
    sum += x;
    square += x * x;
    const auto n = static_cast<double>(b.size() - k);
    const double error = std::max(0.0, square - sum * sum / n) / (n * n);
    if (2 * k <= b.size() && error <= best) {
      best = error;
      cut = k;
    }
  }
  return cut * mser_batch;
}

double correlation_time(const std::vector<double>& values) {
  const double level = mean(values);
  double zero = 0;
  for (double v : values) zero += (v - level) * (v - level);
  if (zero == 0) return 0.5;
  double time = 0.5;
  for (std::size_t lag = 1; lag < values.size() / 2; ++lag) {
    double sum = 0;
    for (std::size_t i = 0; i + lag < values.size(); ++i)
      sum += (values[i] - level) * (values[i + lag] - level);
    if (sum <= 0) break;
    time += sum / zero;
  }
  return time;
}

SteadyState find_steady_state(const std::vector<SteadySignal>& signals, double interval,
                              double residence_time) {
  if (signals.empty()) return {std::nullopt, "nothing is measured"};
  std::size_t cut = 0;
  for (const SteadySignal& s : signals) {
    if (s.values.size() < static_cast<std::size_t>(batches))
      return {std::nullopt,
              fmt::format("{}: {} slots of {:.3g} s are too few", s.name, s.values.size(), interval)};
    const std::size_t own = mser_cut(s.values);
    if (2 * own + mser_batch > s.values.size())
      return {std::nullopt, fmt::format("{}: still changing in the second half of the run", s.name)};
    cut = std::max(cut, own);
  }
  for (const SteadySignal& s : signals) {
    const std::vector<double> tail(
        s.values.begin() + static_cast<std::ptrdiff_t>(std::min(cut, s.values.size())), s.values.end());
    const double length = static_cast<double>(tail.size()) * interval;
    if (tail.size() < static_cast<std::size_t>(batches))
      return {std::nullopt, fmt::format("{}: only {:.3g} s are left after the start-up", s.name, length)};
    if (mean(tail) == 0) return {std::nullopt, fmt::format("{}: nothing came yet", s.name)};
    if (length < residence_times * residence_time)
      return {std::nullopt,
              fmt::format("{}: {:.3g} s after the start-up are fewer than {:g} residence times of {:.3g} s",
                          s.name, length, residence_times, residence_time)};
    const double needed = batches * correlation_times * correlation_time(tail) * interval;
    if (length < needed)
      return {std::nullopt,
              fmt::format("{}: {:.3g} s after the start-up are too short for its slow swings ({:.3g} s "
                          "needed)",
                          s.name, length, needed)};
    const double change = trend(tail);
    if (std::abs(change) > trend_share * std::abs(mean(tail)))
      return {std::nullopt,
              fmt::format("{}: drifts by {:.0f} % over {:.3g} s", s.name, 100 * change / mean(tail), length)};
  }
  return {static_cast<double>(cut) * interval, ""};
}

}  // namespace sluice
