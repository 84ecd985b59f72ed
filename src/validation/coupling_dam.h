#pragma once
/// A dam breaks on to a heap of rocks or a resolved cube: what passes between them is as smooth as the flow,
/// and nothing is lost.
///
/// Reference: rows `peak` (largest force on all rocks in a step, over the largest mean of 10 ms), `water` and
/// `rocks` (mass at the end over that at the start) and `momentum` (what the two sides gave each other, over
/// what passed between them).

#include "validation/measure.h"

namespace sluice {

struct CouplingDam : Measure {
  double cells = 16;  ///< of the grid over the column's height
  double seconds = 1;
  bool cube = false;  ///< of 90 mm, resolved, in a channel three times as wide; instead of 180 rocks of 20 mm

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
