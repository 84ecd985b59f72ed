#pragma once
/// A jet meets the middle of a held block's face at right angles and leaves along it: the block's force is
/// the jet's flux of momentum.
///
/// Reference: columns `bore` [m] and `speed` [m/s] of the jet, `force` [N].

#include "validation/measure.h"

namespace sluice {

struct CouplingJet : Measure {
  double cells = 4;         ///< grid cells across the jet
  double bores = 4;         ///< width of the block over the jet's
  double blockiness = 16;   ///< of the block
  double resolve_from = 3;  ///< of the coupling
  double passes = 24;       ///< bores that the jet runs; the last half is read

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
