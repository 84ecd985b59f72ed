#pragma once
/// Water that comes down an open channel: a rectangular section, upright across the way it goes.
///
///        width
///    |<-------->|
///    |~~~~~~~~~~|  surface      sheets of points travel with the water; each holds whole rows of equal flux,
///    |..........|  depth        so that every point carries the same mass and the density is even over the
///    |__________|               section, for a flat as for a turbulent profile. Points come under the
///                               pressure of the water above them.
///
/// Rapid water, faster than its waves, comes with the push of the water behind it, rho g depth^2 / 2 across
/// the width, beside its momentum; it needs no wall behind. Slow water runs back where there is none, and its
/// depth is decided downstream.

#include <memory>

#include "inflow/inflow.h"
#include "inflow/outlets.h"

namespace sluice {

enum class ChannelProfile {
  flat,       ///< one speed over the depth
  turbulent,  ///< (z/depth)^(1/7) above the bed; mean over largest speed 7/8
};

/// Keys of an entry of `channels:`.
struct ChannelInflowConfig {
  std::string name;
  double width = 0, depth = 0;  ///< of the section [m]
  ChannelProfile profile = ChannelProfile::flat;
  OutletRow outlets;  ///< the middle of the section is the outlet's
  Location where;
  void keys(Schema& s);
  double speed() const;  ///< mean over the section [m/s]
};

/// @throws InputError where the scene has no water, or the channel runs straight up or down
std::unique_ptr<Inflow> make_channel_inflow(const ChannelInflowConfig& config, const InflowTarget& target);

/// Faster than waves on it. @param gravity  across the flow [m/s2]
bool is_rapid(const ChannelInflowConfig& config, double gravity);

/// Of the water as it comes in, with the push of the water behind it. @param gravity  across the flow [m/s2]
double fastest_speed(const ChannelInflowConfig& config, double gravity);

/// Height over depth below which the share F of the flow passes.
double flux_height(ChannelProfile profile, double F);
/// Speed at the height z/depth over the mean speed.
double profile_speed(ChannelProfile profile, double z);

}  // namespace sluice
