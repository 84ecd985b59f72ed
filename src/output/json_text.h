#pragma once
/// JSON put together from text, for records that are only written.

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sluice {

std::string json_string(const std::string& text);
/// null for what is not finite or absent.
std::string json_number(double x);
std::string json_number(const std::optional<double>& x);
inline std::string json_flag(bool x) {
  return x ? "true" : "false";
}

/// Keys in order, each with its JSON.
using JsonMembers = std::vector<std::pair<std::string, std::string>>;
/// On one line, or a member a line, indented.
enum class JsonForm { line, lines };
std::string json_object(const JsonMembers& members, JsonForm form = JsonForm::line);
std::string json_array(const std::vector<std::string>& items, JsonForm form = JsonForm::line);
std::string json_strings(const std::vector<std::string>& texts);

}  // namespace sluice
