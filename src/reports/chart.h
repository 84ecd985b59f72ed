#pragma once
/// Charts as SVG: they print, they need no script, and they are the same on every machine.

#include <limits>
#include <string>
#include <vector>

namespace sluice {

struct ChartAxes {
  std::string title;
  std::string x_label, y_label;   ///< with unit
  int width = 560, height = 280;  ///< [px]
};

/// One named row of values; NaN leaves a gap.
struct ChartSeries {
  std::string name;
  std::vector<double> x, y;
  std::vector<double> low, high;  ///< limits of y, or empty
};

/// Places on an axis between which 3 to 7 round steps lie.
std::vector<double> round_ticks(double low, double high);

/// Lines over x.
std::string line_chart(const ChartAxes& axes, const std::vector<ChartSeries>& series);

/// A chart over bins: series[k].y[i] is bin i, from edges[i] to edges[i + 1]; limits as whiskers.
std::string bin_chart(const ChartAxes& axes, const std::vector<double>& edges,
                      const std::vector<ChartSeries>& series);

/// Colour of the k-th series, as in the page's interactive charts.
std::string series_colour(std::size_t k);

}  // namespace sluice
