#pragma once
/// Drag on one held rock in an even stream, over its size in cells.
///
/// The box is periodic and as wide as the rock's kernel; read is the mean force in the second half of the
/// time, over that of the law at the stream's speed.
///
/// Reference: columns `diameter` [m], `stream` [m/s], `drag` [N].

#include "coupling/coupling.h"
#include "validation/measure.h"

namespace sluice {

struct CouplingStream : Measure {
  double size_cells = 1;               ///< of the rock
  std::optional<double> resolve_from;  ///< of the coupling
  double sizes = 1;                    ///< that the stream passes in the time

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
