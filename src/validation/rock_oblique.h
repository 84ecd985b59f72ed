#pragma once
/// Oblique impact of an elastic sphere on a rough wall: tangential spring and Coulomb's limit.
///
/// Reference: columns `kappa` (k_t / k_n), `psi1` and `psi2`, the tangential speed of the contact point
/// before and after, over mu x normal speed.

#include "validation/measure.h"

namespace sluice {

struct RockOblique : Measure {
  double steps_per_contact = 100;
  double friction = 0.3;

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
