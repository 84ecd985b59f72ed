#pragma once
/// Frequency of the first standing wave in a square tank, over cells along its length.
///
/// The motion is projected on the wave's own velocity field; zero crossings give the period. Reference:
/// columns `length`, `depth` [m], `omega` [rad/s].

#include "validation/measure.h"

namespace sluice {

struct WaterSloshing : Measure {
  double cells = 16;        ///< along the tank
  double amplitude = 0.02;  ///< of the surface over the length
  double periods = 2;

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
