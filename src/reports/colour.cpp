#include "reports/colour.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sluice {
namespace {

// our own choice; the page's viewer.ts holds the same stops
const std::array<Colour, 6> stops = {Colour(0.043F, 0.145F, 0.400F), Colour(0.067F, 0.337F, 0.643F),
                                     Colour(0.063F, 0.545F, 0.737F), Colour(0.239F, 0.729F, 0.690F),
                                     Colour(0.635F, 0.867F, 0.600F), Colour(0.988F, 0.957F, 0.639F)};

}  // namespace

Colour speed_colour(double fraction) {
  const double place = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const auto t = static_cast<float>(place - static_cast<double>(k));
  return stops[k] * (1 - t) + stops[k + 1] * t;
}

std::string hex(const Colour& colour) {
  const auto byte = [](float x) { return static_cast<int>(std::lround(std::clamp(x, 0.0F, 1.0F) * 255)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.x()), byte(colour.y()), byte(colour.z()));
}

std::string speed_gradient_css() {
  std::string css;
  for (const Colour& stop : stops) css += (css.empty() ? "" : ",") + hex(stop);
  return css;
}

}  // namespace sluice
