#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "base/units.h"

namespace sluice {
namespace {

/// Six significant digits, without trailing zeros and without exponents in the range people read.
std::string digits_of(double value) {
  const double size = std::abs(value);
  if (size >= 1e6 && size < 1e15) return fmt::format("{:.0f}", value);
  return fmt::format("{:.6g}", value);
}

struct Scale {
  double from;    ///< smallest magnitude, in the SI unit, shown in this unit
  double factor;  ///< SI value of one
  const char* name;
};

}  // namespace

std::string for_people(double value, std::string_view unit) {
  static const std::map<std::string_view, std::vector<Scale>> scales{
      {"m", {{1, 1, "m"}, {1e-3, 1e-3, "mm"}, {0, 1e-6, "um"}}},
      {"s", {{7200, 3600, "h"}, {300, 60, "min"}, {1, 1, "s"}, {1e-3, 1e-3, "ms"}, {0, 1e-6, "us"}}},
      {"kg", {{1000, 1000, "t"}, {1, 1, "kg"}, {0, 1e-3, "g"}}},
      {"kg/s", {{1e-2, 1 / 3.6, "t/h"}, {0, 1, "kg/s"}}},
      {"m3/s", {{1e-5, 1 / 3600.0, "m3/h"}, {0, 1, "m3/s"}}},
      {"rad", {{0, std::numbers::pi / 180, "deg"}}},
      {"Pa", {{1e6, 1e6, "MPa"}, {1e3, 1e3, "kPa"}, {0, 1, "Pa"}}},
      {"Pa s", {{1, 1, "Pa s"}, {0, 1e-3, "mPa s"}}},
      {"N", {{1e6, 1e6, "MN"}, {1e3, 1e3, "kN"}, {0, 1, "N"}}},
      {"N/m", {{1e6, 1e6, "MN/m"}, {1e3, 1e3, "kN/m"}, {0, 1, "N/m"}}},
      {"J", {{1e6, 1e6, "MJ"}, {1e3, 1e3, "kJ"}, {0, 1, "J"}}},
      {"B", {{1e9, 1e9, "GB"}, {1e6, 1e6, "MB"}, {1e3, 1e3, "kB"}, {0, 1, "B"}}},
  };
  if (unit.empty()) return digits_of(value);
  const auto found = scales.find(unit);
  if (value == 0 || !std::isfinite(value) || found == scales.end())
    return fmt::format("{} {}", digits_of(value), unit);
  for (const Scale& scale : found->second)
    if (std::abs(value) >= scale.from * (1 - 1e-12))
      return fmt::format("{} {}", digits_of(value / scale.factor), scale.name);
  return fmt::format("{} {}", digits_of(value), unit);
}

}  // namespace sluice
