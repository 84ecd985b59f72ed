#pragma once
/// Depth of water behind and ahead of a dam that is gone at once, over cells in its depth. The bed ahead is
/// dry, or under water that is less deep.
///
/// Reference: columns `place` (x / (t sqrt(g h0)), from the dam), `depth` (over h0).

#include "validation/measure.h"

namespace sluice {

struct WaterDamBreak : Measure {
  double cells = 8;  ///< in the depth behind the dam
  double time = 5;   ///< when it is looked at, over sqrt(h0 / g)
  double tail = 0;   ///< depth of the water ahead, over h0

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
