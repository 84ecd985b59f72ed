#pragma once
/// The first standing wave in a square tank: its frequency, and how fast it decays.
///
/// The motion is projected on the wave's own velocity field. Reference: columns `length`, `depth` [m] and
/// `omega` [rad/s] of the wave without viscosity.

#include "validation/measure.h"

namespace sluice {

/// Frequency from zero crossings.
struct WaterSloshing : Measure {
  double cells = 16;        ///< along the tank
  double amplitude = 0.02;  ///< of the surface over the length
  double periods = 2;

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

/// Decay from the slope of the logarithm of the extremes. With `kinematic_viscosity` of water it says how
/// thick the scheme makes it: rate / (2 k^2) is the effective viscosity. Reference: also `quantity`, which is
/// `rate` [1/s], `effective viscosity` [m2/s] or `rise` (of that viscosity at a third of the step, over it),
/// with its `value` and `scale`.
struct WaterWaveDecay : Measure {
  double cells = 16;
  double amplitude = 0.02;
  double periods = 4;
  double kinematic_viscosity = 1e-6;  ///< [m2/s]
  double courant = 0.3;

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
