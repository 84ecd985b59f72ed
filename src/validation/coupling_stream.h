#pragma once
/// Drag on one held rock in an even stream, over its size in cells.
///
/// The box is periodic and as wide as the rock's kernel; read is the mean force while the stream passes from
/// half to one size, over that of the law at the stream's speed.
///
/// Reference: columns `diameter` [m], `stream` [m/s], `drag` [N].

#include "coupling/coupling.h"
#include "validation/measure.h"

namespace sluice {

struct CouplingStream : Measure {
  double size_cells = 1;  ///< of the rock

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
