#pragma once
/// Oblique impact of a sphere on a rigid plane under Hertz-Mindlin.
///
/// Reference, `vary: angle` (from the normal, at constant speed): columns `angle` [deg],
/// `tangential_restitution` of the centre, `spin` [rad/s]; empty where there is none.
/// `vary: tangential_speed` (at constant speed along the normal): columns `psi1`, `psi2`, the touching
/// point's speed before and after over mu v_n.

#include "validation/measure.h"
#include "validation/rock_impact.h"

namespace sluice {

enum class ObliqueVary { angle, tangential_speed };

struct RockHertzOblique : Measure {
  double steps_per_contact = 30;
  double radius = 0.0025;                                  ///< [m]
  double speed = 3.9;                                      ///< in all, or along the normal [m/s]
  double density = 4000, modulus = 380e9, poisson = 0.23;  ///< [kg/m3], [Pa]
  double friction = 0.092, restitution = 0.98;
  Tangential tangential = Tangential::rescaled;
  ObliqueVary vary = ObliqueVary::angle;
  std::string curve;   ///< file of measured_table.h; "" = none
  std::string series;  ///< of that file

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
