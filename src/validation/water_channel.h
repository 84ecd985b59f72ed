#pragma once
/// Start-up of viscous flow between plates: driven by a body force or by the upper plate.
///
/// The liquid may have a yield stress and a flow index; its K is then rho nu at a shear rate of F H / nu.
///
/// Reference: columns `time` (nu t / H^2), `place` (y / H), `speed` (over F H^2 / nu, or over U).

#include "validation/measure.h"

namespace sluice {

enum class ChannelDrive { force, plate };

struct WaterChannel : Measure {
  double cells = 16;  ///< across
  ChannelDrive drive = ChannelDrive::force;
  double yield_stress = 0;    ///< over rho F H
  double yield_rate = 0.003;  ///< over F H / nu
  double flow_index = 1;

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
