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

/// Half width of the 95 % limits of a figure that is no plain mean (a ratio, an unevenness, a quantile): the
/// jackknife over batches (Munoz & Glynn 1997). For a mean it is that of `batch_mean`.
/// @param without  the figure with each batch left out in turn
/// @return NaN for fewer than four batches, or where the figure has no value without one of them
double jackknife_half_width(const std::vector<double>& without);

/// Mean over independent repetitions and its 95 % limits; four repetitions at least.
Estimate replicate_mean(const std::vector<double>& repetitions);

/// Batches of equal length at the end of a series: `count` batches of `length` values, after `first` values
/// that belong to none. No batches where there are fewer than four values.
struct Batches {
  std::size_t first = 0, length = 0, count = 0;
};
Batches batches_of(std::size_t values);

/// Size below which the share q of the mass lies: the cumulative curve is straight between the middles of
/// the values' own masses. NaN for an empty list.
double weighted_quantile(const std::vector<double>& values, const std::vector<double>& masses, double q);

}  // namespace sluice
