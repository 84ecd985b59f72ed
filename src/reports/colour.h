#pragma once
/// Colours and the scale that speeds are shown in, alike in pictures, charts and the 3D view.

#include <string>

#include "base/vec.h"

namespace sluice {

using Colour = Vec3f;  ///< red, green, blue, 0..1, as displayed (sRGB)

/// From dark blue (0) over teal to pale yellow (1): lighter means more, also in black and white.
Colour speed_colour(double fraction);

/// The scale as stops of a CSS gradient.
std::string speed_gradient_css();

/// "#rrggbb"
std::string hex(const Colour& colour);

}  // namespace sluice
