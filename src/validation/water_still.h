#pragma once
/// Pressure of a still column of water, points jittered at the start, over cells in its depth.
///
/// Mean over the last second; what lies within a cell of floor and surface is left out of the
/// reference. Reference: columns `z` [m], `pressure` [Pa], for a depth of 0.5 m and sound ten times as
/// fast as sqrt(2 g H).

#include "mpm/mpm_system.h"
#include "validation/measure.h"

namespace sluice {

struct WaterStill : Measure {
  double cells = 16;     ///< in the depth
  double depth = 0.5;    ///< [m]
  double seconds = 4;    ///< [s]
  double jitter = 0.25;  ///< of the points' distance
  Precision precision = Precision::single;
  double sound_factor = 1;  ///< over the sound speed of the reference; other than 1 is a fault

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
