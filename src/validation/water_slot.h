#pragma once
/// Discharge coefficient of a slot in the floor of a tank, over cells across the slot.
///
/// Flow over slot area x sqrt(2 g H) of a level that falls meanwhile, speed of approach included.
/// Reference: column `coefficient`.

#include "validation/measure.h"

namespace sluice {

struct WaterSlot : Measure {
  double cells = 2;            ///< across the slot
  double slot = 0.02;          ///< width of the slot [m]
  double depth = 0.3;          ///< of water at the start [m]
  double tank_over_slot = 10;  ///< widths
  double settle = 0.1;         ///< before counting [s]
  double seconds = 0.2;        ///< of counting [s]

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
