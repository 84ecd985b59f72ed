#pragma once
/// Decay of a Taylor-Green vortex in a periodic box, over cells along its side.
///
/// Reference: columns `time` (t U / L), `energy` (kinetic, over that of the start).

#include "validation/measure.h"

namespace sluice {

struct WaterTaylorGreen : Measure {
  double cells = 32;      ///< along a side
  double reynolds = 100;  ///< U L / nu
  double mach = 0.1;      ///< U over the speed of sound

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
