#pragma once
/// Normal impact of elastic spheres: largest force and overlap, time of contact, and the published curves.
///
/// Reference: columns `material`, `density` [kg/m3], `youngs_modulus` [Pa], `poissons_ratio`, `overlap` [m],
/// `force` [N], `time` [s]. The curves are of the first row's material: `t_us` or `overlap_um`, `F_kN`.

#include "validation/measure.h"
#include "validation/rock_impact.h"

namespace sluice {

struct RockHertz : Measure {
  double steps_per_contact = 30;
  double radius = 0.01;  ///< [m]
  double speed = 1;      ///< of each sphere [m/s]
  ImpactAgainst against = ImpactAgainst::plane;
  std::string force_time, force_overlap;  ///< files of measured_table.h; "" = none

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
