#pragma once
/// A jet that falls from a pipe gains speed and grows thinner, over cells across the bore.
///
/// Reference: columns `drop` [m], `speed` [m/s], `width` (d / d0), for a jet that leaves at 2 m/s.

#include "validation/measure.h"

namespace sluice {

struct WaterJet : Measure {
  double cells = 4;      ///< across the bore
  double bore = 0.08;    ///< [m]
  double speed = 2;      ///< at the pipe [m/s]
  double seconds = 0.6;  ///< the last third counts [s]

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
