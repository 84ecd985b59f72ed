#pragma once
/// Spray nozzles as a catalogue describes them: flow at a rated pressure, pattern, angle.
///
/// Flow goes with the root of the pressure, Q = Q_rated sqrt(p / p_rated); the droplets leave at
/// v = c_v sqrt(2 p / rho) (Bernoulli). Directions follow a low-discrepancy sequence (Roberts 2018, R2) so
/// that the flux over the angle is even after few points.

#include <memory>

#include "inflow/inflow.h"
#include "inflow/outlets.h"

namespace sluice {

enum class SprayPattern {
  flat_fan,   ///< flux even over the fan's angle and over its thickness
  full_cone,  ///< flux even over the solid angle
};

/// Keys of an inflow with `kind: nozzle`.
struct SprayNozzleConfig {
  std::string name;
  double rated_flow = 0;      ///< of one nozzle [m3/s]
  double rated_pressure = 0;  ///< [Pa]
  SprayPattern pattern = SprayPattern::flat_fan;
  double angle = 0;                    ///< full opening angle [rad]
  double thickness = 0.0873;           ///< flat fan: full angle across the fan [rad]; default 5 degrees
  std::optional<double> pressure;      ///< before the nozzle, over ambient [Pa]
  double velocity_coefficient = 0.95;  ///< speed over Bernoulli's
  double roll = 0;                     ///< about the direction [rad]; 0: the fan's width lies level
  OutletRow outlets;                   ///< its flow and total_flow stand instead of a pressure
  Location where;
  void keys(Schema& s);
  double operating_pressure() const;   ///< [Pa]
  double flow_each() const;            ///< of one open nozzle [m3/s]
  double speed(double density) const;  ///< of the droplets [m/s]
};

/// @throws InputError where the scene has no water
std::unique_ptr<Inflow> make_spray_nozzle(const SprayNozzleConfig& config, const InflowTarget& target);

}  // namespace sluice
