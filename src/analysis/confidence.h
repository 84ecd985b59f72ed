#pragma once
/// Means of correlated series with confidence limits, by batch means.

#include <cstddef>
#include <vector>

namespace sluice {

/// A mean and the half width of its 95 % confidence interval; NaN where the series is too short for one.
struct Estimate {
  double value = 0;
  double half_width = 0;
};

/// Quantile 0.975 of Student's t with `freedom` >= 3 degrees of freedom, to 1 %: Abramowitz & Stegun 26.7.5.
double student_t_975(double freedom);

/// Mean of a series and its 95 % limits from the means of up to 20 batches of equal length; four batches at
/// least (Law & Kelton). The first values that do not fill a batch count in the mean only.
Estimate batch_mean(const std::vector<double>& series);

/// Size below which the share q of the mass lies: the cumulative curve is straight between the middles of
/// the values' own masses. NaN for an empty list.
double weighted_quantile(const std::vector<double>& values, const std::vector<double>& masses, double q);

}  // namespace sluice
