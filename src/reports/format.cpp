#include "reports/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sluice {
namespace {

constexpr const char* thin_space = "\u202f";

std::string superscript(int n) {
  static constexpr std::array<const char*, 10> digits = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                                         "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string out;
  for (const char c : fmt::format("{}", n))
    out += c == '-' ? "\u207b" : digits[static_cast<std::size_t>(c - '0')];
  return out;
}

/// Groups of three before the decimal point.
std::string grouped(const std::string& digits) {
  const std::size_t sign = !digits.empty() && digits[0] == '-' ? 1 : 0;
  const std::size_t point = std::min(digits.find('.'), digits.size());
  if (point - sign <= 4) return digits;  // 1234 needs none
  std::string out = digits.substr(0, sign);
  for (std::size_t k = sign; k < point; ++k) {
    if (k > sign && (point - k) % 3 == 0) out += thin_space;
    out += digits[k];
  }
  return out + digits.substr(point);
}

}  // namespace

std::string html(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string script_json(std::string_view json) {
  std::string out;
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";  // neither </script> nor <!-- can arise
    else
      out += c;
  }
  return out;
}

std::string number(double x, int digits) {
  if (!std::isfinite(x)) return "\u2013";
  if (x == 0) return "0";
  const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(x))));
  if (magnitude < -4 || magnitude > 8) {
    const double mantissa = x / std::pow(10.0, magnitude);
    return fmt::format("{:.{}f}\u00b710{}", mantissa, std::max(0, digits - 2), superscript(magnitude));
  }
  const int decimals = std::max(0, digits - 1 - magnitude);
  return grouped(fmt::format("{:.{}f}", x, decimals));
}

std::string number(std::optional<double> x, int digits) {
  return number(x.value_or(std::nan("")), digits);
}

std::string number_with_limits(double x, double half_width) {
  if (!std::isfinite(x)) return number(x);
  if (!std::isfinite(half_width) || half_width < 0) return number(x);
  if (half_width < 1e-6 * std::abs(x) || half_width < 1e-4)
    return number(x) + " \u00b1 " + number(half_width, 1);
  int place = static_cast<int>(std::floor(std::log10(half_width)));
  if (half_width < 1.95 * std::pow(10, place)) --place;  // a leading 1 keeps a second digit
  const double step = std::pow(10, place);
  const auto rounded = [&](double v) {
    return grouped(fmt::format("{:.{}f}", std::round(v / step) * step, std::max(0, -place)));
  };
  return rounded(x) + " \u00b1 " + rounded(half_width);
}

std::string count(double n) {
  return std::isfinite(n) ? grouped(fmt::format("{:.0f}", n)) : "\u2013";
}

std::string duration(double seconds) {
  if (!std::isfinite(seconds)) return "\u2013";
  if (seconds < 60) return number(seconds, 3) + " s";
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string memory(double bytes) {
  if (bytes < 1e3) return number(bytes, 3) + " B";
  if (bytes < 1e6) return number(bytes / 1e3, 3) + " kB";
  if (bytes < 1e9) return number(bytes / 1e6, 3) + " MB";
  return number(bytes / 1e9, 3) + " GB";
}

}  // namespace sluice
