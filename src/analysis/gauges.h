#pragma once
/// Gauges: what stands in series.csv beside the budgets.

#include <memory>

#include "analysis/probe.h"
#include "base/schema.h"

namespace sluice {

enum class GaugeKind {
  level,     ///< height of the water's surface at a place
  pressure,  ///< mean pressure of the water in a box
  holdup,    ///< rock and water in a box
};

/// Keys under `gauges: NAME:`.
struct GaugeConfig {
  std::string name;
  GaugeKind kind = GaugeKind::holdup;
  double x = 0, y = 0;            ///< level: where [m]
  double radius = 0;              ///< level: of the upright column that is looked at [m]
  std::optional<Vec3> low, high;  ///< pressure, holdup: box; holdup without one: everything [m]
  double interval = 0.05;         ///< [s]
  Location where;                 ///< of the mapping, for messages
  void keys(Schema& s);
};

std::unique_ptr<Probe> make_gauge(const GaugeConfig& config);

/// Height of the surface of a column of equal masses from the heights of its points: median + half the
/// column, whose length follows from the 10 % and 90 % points, so that droplets above hardly count. NaN for
/// fewer than three points.
double column_level(std::vector<double> heights);

}  // namespace sluice
