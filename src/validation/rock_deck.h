#pragma once
/// Speed at which a vibrating deck transports a flat block that sticks and slides, or a ball that it throws.
///
/// The deck moves along a line, stroke/2 sin(2 pi f t), at `throw_angle` above itself; gravity is tilted
/// instead of the deck. The way is taken over whole periods. Reference: columns `tilt` [deg] (downhill along
/// the transport), `friction`, `throw_angle` [deg], `frequency` [Hz], `stroke` [m], `speed` [m/s], for
/// restitution 0.1.

#include "validation/measure.h"

namespace sluice {

struct RockDeck : Measure {
  double stiffness_per_size = 1e7;  ///< [N/m2]
  double size = 0.02;               ///< diameter, or edge of the block, four times its height [m]
  double blockiness = 16;           ///< 2 = ball
  double restitution = 0.1;
  double steps_per_contact = 30;
  std::int64_t periods_before = 10, periods = 10;  ///< of the deck, before and while it is measured

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;
};

}  // namespace sluice
