#pragma once
/// Chart with logarithmic axes: error against run time.

#include <string>
#include <vector>

#include "reports/chart.h"

namespace sluice {

/// Points joined by lines; values that are not above 0 leave a gap. A level line stands for a limit.
/// @param labels  of the points of the first series, or empty;  @param limits  levels on the y axis
std::string log_chart(const ChartAxes& axes, const std::vector<ChartSeries>& series,
                      const std::vector<std::string>& labels, const std::vector<double>& limits);

}  // namespace sluice
