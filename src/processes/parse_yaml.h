#pragma once
/// YAML text -> InputNode. The only place that knows the YAML library.

#include <string>
#include <vector>

#include "processes/input_node.h"

namespace sluice {

/// Reads one YAML document.
/// @param place     file name shown in locations; @param folder  what named files are relative to
/// @param problems  receives duplicate keys, keys that are not words, trees too deep or too large
/// @throws InputError for what is not YAML, for an empty text and for several documents
InputNode parse_yaml(const std::string& text, const std::string& place, const std::string& folder,
                     std::vector<InputProblem>& problems);

}  // namespace sluice
