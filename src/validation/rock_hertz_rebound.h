#pragma once
/// Restitution of a damped Hertzian sphere on a rigid plane, over steps per contact.
///
/// Reference: columns `material`, `density` [kg/m3], `youngs_modulus` [Pa], `poissons_ratio`, `restitution`.

#include "validation/measure.h"

namespace sluice {

struct RockHertzRebound : Measure {
  double steps_per_contact = 30;
  double radius = 0.0025;  ///< [m]
  double speed = 3.9;      ///< [m/s]

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
