#pragma once
/// Start-up of viscous flow between plates: driven by a body force or by the upper plate.
///
/// Reference: columns `time` (nu t / H^2), `place` (y / H), `speed` (over F H^2 / nu, or over U).

#include "validation/measure.h"

namespace sluice {

enum class ChannelDrive { force, plate };

struct WaterChannel : Measure {
  double cells = 16;  ///< across
  ChannelDrive drive = ChannelDrive::force;

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
