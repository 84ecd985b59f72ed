#pragma once
/// Quantities with units, read through UDUNITS-2.

#include <optional>
#include <string>
#include <string_view>

namespace sluice {

/// Outcome of reading "25 mm": a value in the wanted unit, or what is wrong.
struct Quantity {
  std::optional<double> value;
  std::string problem;     ///< "has unit 'kg'"
  std::string reason;      ///< "a length is needed"
  std::string suggestion;  ///< "use m, mm or in"
};

/// Reads text such as "1200 t/h", "450 m3/h", "25 mm", "35 deg" as a number in `unit` (an SI unit
/// such as "m", "kg/s", "rad"; "" = plain number, "%" understood). A bare number where a dimension is
/// needed, an unknown unit, another dimension, nan and inf are problems. `t` is the tonne.
Quantity read_quantity(std::string_view text, std::string_view unit);

/// What a unit measures, in words: "a length", "m, mm or in". A unit without a name of its own: "a value
/// in kg m2", "kg m2".
struct UnitWords {
  std::string noun;
  std::string examples;
};
UnitWords describe_unit(std::string_view unit);

/// A value for people: 0.025, "m" -> "25 mm".
std::string for_people(double value, std::string_view unit);

}  // namespace sluice
