#pragma once
/// Numbers and text as people read them on a page.

#include <optional>
#include <string>
#include <string_view>

namespace sluice {

/// Text made safe for HTML, in content and in attributes.
std::string html(std::string_view text);
/// JSON made safe inside a <script> element.
std::string script_json(std::string_view json);

/// `digits` significant digits, thousands apart by a thin space, "-" for what is not a number.
std::string number(double x, int digits = 3);
std::string number(std::optional<double> x, int digits = 3);
/// "0.21 ± 0.02": the limits to one significant digit (two where it is a 1), the value to the same place; the
/// value alone where there are no limits.
std::string number_with_limits(double x, double half_width);
/// A whole count, thousands apart.
std::string count(double n);
/// "1.5 s", "3 min 20 s", "2 h 5 min"
std::string duration(double seconds);
/// "12.4 MB"
std::string memory(double bytes);

/// kg/s as t/h, what plants count in.
inline double t_h(double kg_s) {
  return 3.6 * kg_s;
}

}  // namespace sluice
