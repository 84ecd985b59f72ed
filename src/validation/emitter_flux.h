#pragma once
/// Flux of a spray nozzle on a plane below it, over the number of points.
///
/// Reference: columns `angle` (full) [deg], `place` (over the edge's distance), `flux` at 0.3 m below, of
/// unit flow: 1/m for a flat fan, 1/m2 for a full cone.

#include "inflow/spray_nozzle.h"
#include "validation/measure.h"

namespace sluice {

struct EmitterFlux : Measure {
  std::int64_t points = 1000;
  SprayPattern pattern = SprayPattern::flat_fan;

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
