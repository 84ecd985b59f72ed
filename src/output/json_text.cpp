#include "output/json_text.h"

#include <fmt/format.h>

#include <cmath>

namespace sluice {

namespace {

std::string indented(const std::string& text) {
  std::string out;
  for (const char c : text) {
    out += c;
    if (c == '\n') out += "  ";
  }
  return out;
}

std::string enclosed(const std::vector<std::string>& items, JsonForm form, char open, char close) {
  std::string out(1, open);
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (form == JsonForm::lines)
      out += "\n  " + indented(items[k]);
    else
      out += (k > 0 ? " " : "") + items[k];
    if (k + 1 < items.size()) out += ',';
  }
  if (form == JsonForm::lines && !items.empty()) out += '\n';
  return out + close;
}

}  // namespace

std::string json_string(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\u{:04x}", static_cast<int>(c));
    else
      out += c;
  }
  return out + '"';
}

std::string json_number(double x) {
  return std::isfinite(x) ? fmt::format("{:.9g}", x) : "null";
}
std::string json_number(const std::optional<double>& x) {
  return x ? json_number(*x) : "null";
}

std::string json_object(const JsonMembers& members, JsonForm form) {
  std::vector<std::string> items;
  for (const auto& [key, value] : members) items.push_back(json_string(key) + ": " + value);
  return enclosed(items, form, '{', '}');
}

std::string json_array(const std::vector<std::string>& items, JsonForm form) {
  return enclosed(items, form, '[', ']');
}

std::string json_strings(const std::vector<std::string>& texts) {
  std::vector<std::string> items;
  for (const std::string& text : texts) items.push_back(json_string(text));
  return json_array(items, JsonForm::line);
}

}  // namespace sluice
