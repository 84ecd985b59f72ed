#pragma once
/// Energy of an undamped, frictionless bed in a closed box under gravity, over steps per contact.
///
/// Energy is looked at a thousand times after a first tenth of the run; the difference between that of the
/// start and each look is set against the kinetic energy. Two values are compared: the mean
/// and the trend (last tenth less first tenth). Reference: column `energy_ratio`, one row: 1.

#include "validation/measure.h"

namespace sluice {

struct RockBedEnergy : Measure {
  double steps_per_contact = 30;
  std::int64_t steps_at_30 = 1'000'000;  ///< the run's length in default steps, whatever the rung
  std::int64_t rocks_along = 4;          ///< rocks along each edge of the starting lattice
  double blockiness = 2;
  double speed = 0.5;  ///< of each rock at the start [m/s]

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
