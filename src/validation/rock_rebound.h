#pragma once
/// Restitution of a sphere that hits a wall, over steps per contact.
///
/// The sphere arrives at many phases of the step; the worst one is taken for each restitution. Reference:
/// columns `restitution`, `phase` (contact time x sqrt(k_n / m)).

#include "dem/contact_law.h"
#include "validation/measure.h"

namespace sluice {

struct RockRebound : Measure {
  double steps_per_contact = 30;
  EndOfContact end_of_contact = EndOfContact::no_tension;
  std::int64_t arrivals = 16;  ///< phases of the step at which the sphere arrives
  double damping_factor = 1;   ///< over the damping that restitution asks for; 1 but for a fault on purpose

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

/// Restitution whose damping is `factor` times that of `restitution`.
double restitution_with_damping(double restitution, double factor, EndOfContact end);

}  // namespace sluice
