#include "base/units.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>

#include "base/errors.h"

namespace sluice {
namespace {

struct UnitDeleter {
  void operator()(ut_unit* u) const { ut_free(u); }
};
using Unit = std::unique_ptr<ut_unit, UnitDeleter>;

/// Powers of the base units, the radian included: UDUNITS itself takes "rad/s" and "Hz" for the same
/// dimension, and 60 rpm would be read as 6.28 Hz.
using Dimension = std::map<std::string, int>;

Dimension dimension_of(const ut_unit* unit) {
  Dimension powers;
  ut_visitor visitor{};
  visitor.visit_basic = [](const ut_unit* basic, void* out) {
    const char* symbol = ut_get_symbol(basic, UT_ASCII);
    (*static_cast<Dimension*>(out))[symbol ? symbol : "?"] = 1;
    return UT_SUCCESS;
  };
  visitor.visit_product = [](const ut_unit*, int count, const ut_unit* const* basics, const int* power,
                             void* out) {
    for (int i = 0; i < count; ++i) {
      const char* symbol = ut_get_symbol(basics[i], UT_ASCII);
      if (power[i] != 0) (*static_cast<Dimension*>(out))[symbol ? symbol : "?"] = power[i];
    }
    return UT_SUCCESS;
  };
  visitor.visit_galilean = [](const ut_unit*, double, const ut_unit* underlying, double, void* out) {
    *static_cast<Dimension*>(out) = dimension_of(underlying);
    return UT_SUCCESS;
  };
  visitor.visit_timestamp = [](const ut_unit*, const ut_unit*, double, void* out) {
    (*static_cast<Dimension*>(out))["timestamp"] = 1;
    return UT_SUCCESS;
  };
  visitor.visit_logarithmic = [](const ut_unit*, double, const ut_unit*, void* out) {
    (*static_cast<Dimension*>(out))["logarithm"] = 1;
    return UT_SUCCESS;
  };
  ut_accept_visitor(unit, &visitor, &powers);
  return powers;
}

struct SystemDeleter {
  void operator()(ut_system* s) const { ut_free_system(s); }
};

/// UDUNITS' tables and our few names for what plants write.
class UnitTable {
 public:
  UnitTable() {
    ut_set_error_message_handler(ut_ignore);
    system_.reset(ut_read_xml(nullptr));
    if (!system_)
      throw EnvironmentError("the unit tables of UDUNITS-2 are missing; install libudunits2-data");
    for (const auto& [name, meaning] : {std::pair{"deg", "degree"}, std::pair{"tph", "t/h"},
                                        std::pair{"cP", "0.001 Pa.s"}, std::pair{"gpm", "gallon/min"}})
      ut_map_symbol_to_unit(name, UT_ASCII, Unit(parse(meaning)).get());
  }
  Unit parse(std::string_view text) const {
    return Unit(ut_parse(system_.get(), std::string(text).c_str(), UT_UTF8));
  }

 private:
  std::unique_ptr<ut_system, SystemDeleter> system_;
};

// Read once and never changed: loading takes milliseconds. UDUNITS' parser is not for several threads.
const UnitTable& unit_table() {
  static const UnitTable table;
  return table;
}
std::mutex& parser_mutex() {
  static std::mutex mutex;
  return mutex;
}

struct DimensionWords {
  const char* unit;
  const char* noun;
  const char* units;
};
constexpr std::array dimension_words{
    DimensionWords{"", "a plain number", "no unit"},
    DimensionWords{"m", "a length", "m, mm or in"},
    DimensionWords{"m2", "an area", "m2 or mm2"},
    DimensionWords{"m3", "a volume", "m3 or l"},
    DimensionWords{"s", "a time", "s, ms or min"},
    DimensionWords{"kg", "a mass", "kg, g or t"},
    DimensionWords{"kg/s", "a mass flow", "t/h or kg/s"},
    DimensionWords{"m3/s", "a volume flow", "m3/h, l/min or l/s"},
    DimensionWords{"m/s", "a speed", "m/s or mm/s"},
    DimensionWords{"m/s2", "an acceleration", "m/s2"},
    DimensionWords{"rad", "an angle", "deg or rad"},
    DimensionWords{"rad/s", "an angular speed", "rpm, deg/s or rad/s"},
    DimensionWords{"Hz", "a frequency", "Hz, 1/min or rpm"},
    DimensionWords{"Pa", "a pressure", "bar, kPa or Pa"},
    DimensionWords{"Pa s", "a viscosity", "Pa s or mPa s"},
    DimensionWords{"m2/s", "a kinematic viscosity", "m2/s or mm2/s"},
    DimensionWords{"kg/m3", "a density", "kg/m3 or t/m3"},
    DimensionWords{"N", "a force", "N or kN"},
    DimensionWords{"N/m", "a stiffness", "N/m or kN/m"},
    DimensionWords{"J", "an energy", "J or kJ"},
    DimensionWords{"W", "a power", "W or kW"},
};

UnitWords words_for(std::string_view unit) {
  const Unit wanted = unit_table().parse(unit);
  for (const DimensionWords& words : dimension_words)
    if (dimension_of(unit_table().parse(words.unit).get()) == dimension_of(wanted.get()))
      return {words.noun, words.units};
  return {fmt::format("a value in {}", unit), std::string(unit)};
}

Quantity wrong(std::string problem, std::string_view unit) {
  const UnitWords words = words_for(unit);
  return {std::nullopt, std::move(problem), words.noun + " is needed",
          unit.empty() ? "leave the unit out" : "use " + words.examples};
}

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && std::isspace(static_cast<unsigned char>(s.front()))) s.remove_prefix(1);
  while (!s.empty() && std::isspace(static_cast<unsigned char>(s.back()))) s.remove_suffix(1);
  return s;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) || c == '_' || c == '%' || (c & 0x80) != 0;
}

/// Length of the decimal number at the start of s: sign, digits with a point, exponent. 0 if none.
std::size_t number_length(std::string_view s) {
  std::size_t i = !s.empty() && (s[0] == '+' || s[0] == '-') ? 1 : 0;
  std::size_t digits = 0;
  for (; i < s.size() && is_digit(s[i]); ++i) ++digits;
  if (i < s.size() && s[i] == '.')
    for (++i; i < s.size() && is_digit(s[i]); ++i) ++digits;
  if (digits == 0) return 0;
  if (i < s.size() && (s[i] == 'e' || s[i] == 'E')) {
    std::size_t k = i + 1;
    if (k < s.size() && (s[k] == '+' || s[k] == '-')) ++k;
    if (k < s.size() && is_digit(s[k])) {
      while (k < s.size() && is_digit(s[k])) ++k;
      i = k;
    }
  }
  return i;
}

/// UDUNITS would read "25 3 mm" as 75 mm and "3 m - 1 m" as a product: digits are exponents here, but
/// for a leading "1/".
bool is_plain_unit(std::string_view unit) {
  if (unit.starts_with("1/")) unit.remove_prefix(2);
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const char c = unit[i];
    const char before = i > 0 ? unit[i - 1] : ' ';
    const char after = i + 1 < unit.size() ? unit[i + 1] : ' ';
    if (is_letter(c) || c == '(' || c == ')' || c == '*' || c == '/' || c == ' ') continue;
    if (is_digit(c) && (is_letter(before) || before == '^' || before == '-') && !is_digit(after)) continue;
    if (c == '-' && (is_letter(before) || before == '^') && is_digit(after)) continue;
    if (c == '^' && is_letter(before) && (is_digit(after) || after == '-')) continue;
    if (c == '.' && (is_letter(before) || is_digit(before)) && is_letter(after)) continue;
    return false;
  }
  return true;
}

std::string without_leading_zeros(std::string_view text) {
  const std::size_t sign = text[0] == '+' || text[0] == '-' ? 1 : 0;
  std::size_t i = sign;
  while (i + 1 < text.size() && text[i] == '0' && is_digit(text[i + 1])) ++i;
  return std::string(text.substr(0, sign)) + std::string(text.substr(i));
}

/// What is wrong with text that does not start with a decimal number.
Quantity not_a_number(std::string_view text, std::string_view unit) {
  std::string lower;
  for (char c : text) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::string_view word = lower;
  while (!word.empty() && (word[0] == '+' || word[0] == '-' || word[0] == '.')) word.remove_prefix(1);
  for (const char* never : {"nan", "infinity", "inf"})
    if (word.starts_with(never)) {
      const std::string_view rest = word.substr(std::string_view(never).size());
      if (!rest.empty() && is_letter(rest[0])) break;
      return {std::nullopt, fmt::format("is '{}'", text), "a finite number is needed", "write a number"};
    }
  return {std::nullopt, fmt::format("is '{}'", text), words_for(unit).noun + " is needed",
          unit.empty() ? "write a number" : fmt::format("write a number and its unit, as in '1 {}'", unit)};
}

}  // namespace

Quantity read_quantity(std::string_view text, std::string_view unit) {
  const std::lock_guard lock(parser_mutex());
  text = trimmed(text);
  const std::size_t length = number_length(text);
  if (length == 0) return not_a_number(text, unit);
  std::string_view digits = text.substr(0, length);
  const std::string_view given = trimmed(text.substr(length));
  if (!given.empty() && (given[0] == ',' || given[0] == '\'') && given.size() > 1 && is_digit(given[1]))
    return {std::nullopt, fmt::format("is '{}'", text), "a number has a decimal point and no other mark",
            "write 1200.5, not 1,200.5 or 1200,5"};
  if (digits[0] == '+') digits.remove_prefix(1);
  const std::string_view magnitude = digits[0] == '-' ? digits.substr(1) : digits;
  const bool octal = magnitude.size() > 1 && magnitude[0] == '0' && is_digit(magnitude[1]);
  const bool hexadecimal = magnitude == "0" && given.size() > 1 && std::strchr("xXoObB", given[0]) &&
                           std::isxdigit(static_cast<unsigned char>(given[1]));
  if (octal || hexadecimal)
    return {std::nullopt, fmt::format("is '{}'", text),
            "a number with a leading zero is octal or hexadecimal to some readers and decimal to others",
            octal ? fmt::format("write '{}'", without_leading_zeros(text)) : "write it in decimals"};
  double number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(number))
    return {std::nullopt, fmt::format("is '{}'", text), "a finite number is needed",
            "write a smaller number"};

  if (given.empty()) {
    if (unit.empty()) return {number, "", "", ""};
    return wrong(fmt::format("is '{}', without a unit", text), unit);
  }
  if (given == "ton" || given == "tons" || given.starts_with("ton/") || given.starts_with("tons/"))
    return {std::nullopt, fmt::format("has unit '{}'", given), "a ton is 907, 1000 or 1016 kg",
            "use t (1000 kg), short_ton or long_ton"};
  const Unit from = is_plain_unit(given) ? unit_table().parse(given) : nullptr;
  if (!from) return wrong(fmt::format("has unit '{}', which is not known", given), unit);
  const Unit to = unit_table().parse(unit);
  if (!to) throw std::logic_error(fmt::format("a key is declared with the unknown unit '{}'", unit));
  const Dimension wanted = dimension_of(to.get());
  // A frequency may be given in turns: 900 rpm is 15 Hz.
  if (given == "rpm" && wanted == dimension_of(unit_table().parse("Hz").get()))
    return {number / 60.0, "", "", ""};
  if (dimension_of(from.get()) != wanted) return wrong(fmt::format("has unit '{}'", given), unit);
  std::unique_ptr<cv_converter, decltype(&cv_free)> converter(ut_get_converter(from.get(), to.get()),
                                                              cv_free);
  if (!converter) return wrong(fmt::format("has unit '{}'", given), unit);
  const double value = cv_convert_double(converter.get(), number);
  if (!std::isfinite(value))
    return {std::nullopt, fmt::format("is '{}'", text), "a finite number is needed",
            "write a smaller number"};
  return {value, "", "", ""};
}

UnitWords describe_unit(std::string_view unit) {
  const std::lock_guard lock(parser_mutex());
  return words_for(unit);
}

}  // namespace sluice
