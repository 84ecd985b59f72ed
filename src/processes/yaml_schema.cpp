#include "processes/yaml_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace sluice {

namespace fs = std::filesystem;
using Kind = InputNode::Kind;

namespace {

/// "1 m", or "1" for plain numbers: what a value looks like.
std::string sample(const KeySpec& spec) {
  if (*spec.example) return spec.example;
  return *spec.unit ? fmt::format("1 {}", spec.unit) : "1";
}

}  // namespace

std::string range_words(const KeySpec& spec) {
  std::vector<std::string> parts;
  if (std::isfinite(spec.above)) parts.push_back("above " + for_people(spec.above, spec.unit));
  if (std::isfinite(spec.at_least)) parts.push_back("at least " + for_people(spec.at_least, spec.unit));
  if (std::isfinite(spec.below)) parts.push_back("below " + for_people(spec.below, spec.unit));
  if (std::isfinite(spec.at_most)) parts.push_back("at most " + for_people(spec.at_most, spec.unit));
  return fmt::format("{}", fmt::join(parts, ", "));
}

Location YamlSchema::at(const char* key) const {
  const InputEntry* entry = section_.value.find(key);
  return entry ? entry->where : section_.where;
}

void YamlSchema::problem(const char* key, std::string problem, std::string reason, std::string suggestion) {
  complain(at(key), key, std::move(problem), std::move(reason), std::move(suggestion));
}

void YamlSchema::report_unknown() {
  for (const InputEntry& entry : section_.value.mapping) {
    if (std::find(known_.begin(), known_.end(), entry.key) != known_.end()) continue;
    if (entry.key == "<<")
      complain(entry.where, entry.key, "is not read", "merge keys are no part of YAML 1.2",
               "write the keys out, or use 'extends' at the top of the file");
    else
      complain(entry.where, entry.key, "is not a key",
               section_.key.empty() ? "of this file" : fmt::format("of '{}'", section_.key),
               suggest_word(entry.key, known_));
  }
}

const InputEntry* YamlSchema::look_up(const char* key, const KeySpec& spec, const std::string& example) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  const InputEntry* entry = section_.value.find(key);
  const bool unclear = kind_unclear_ && *spec.applies_to;
  if (!entry) {
    if (spec.required && spec.applies && !unclear)
      complain(here(), key, missing, spec.doc, fmt::format("add '{}: {}'", key, example));
    return nullptr;
  }
  if (!spec.applies) {
    if (!unclear)
      complain(entry->where, key, "does not apply here",
               *spec.applies_to ? fmt::format("it belongs to {}", spec.applies_to) : "", "leave it out");
    return nullptr;
  }
  if (entry->value.kind == Kind::null) {
    complain(entry->where, key, "is empty", spec.doc,
             fmt::format("write '{}: {}' or leave it out", key, example));
    return nullptr;
  }
  return entry;
}

const InputNode* YamlSchema::scalar(const char* key, const KeySpec& spec, const std::string& needed,
                                    const std::string& example) {
  const InputEntry* entry = look_up(key, spec, example);
  if (!entry) return nullptr;
  if (entry->value.kind == Kind::scalar) return &entry->value;
  complain(entry->value.where, key, "is " + entry->value.describe(), needed + " is needed",
           fmt::format("write '{}: {}'", key, example));
  return nullptr;
}

const InputNode* YamlSchema::items(const char* key, const KeySpec& spec, const std::string& needed,
                                   const std::string& example) {
  const InputEntry* entry = look_up(key, spec, example);
  if (!entry) return nullptr;
  if (entry->value.kind == Kind::list) return &entry->value;
  complain(entry->value.where, key, "is " + entry->value.describe(), needed + " is needed",
           fmt::format("write '{}: {}'", key, example));
  return nullptr;
}

bool YamlSchema::in_range(const char* key, const InputNode& node, double& value, const KeySpec& spec) {
  // "90 deg" may come out a rounding above pi / 2: a value that close is the bound.
  const auto is_bound = [&](double bound) { return std::abs(value - bound) <= 1e-14 * std::abs(bound); };
  for (const double bound : {spec.at_least, spec.at_most, spec.above, spec.below})
    if (std::isfinite(bound) && is_bound(bound)) value = bound;
  if (value >= spec.at_least && value > spec.above && value <= spec.at_most && value < spec.below)
    return true;
  complain(node.where, key, "is " + node.describe(), "out of range",
           fmt::format("use {}", range_words(spec)));
  return false;
}

std::optional<double> YamlSchema::quantity(const char* key, const InputNode& node, const KeySpec& spec) {
  if (node.kind != Kind::scalar) {
    complain(node.where, key, "is " + node.describe(), "a number is needed",
             fmt::format("write '{}'", sample(spec)));
    return std::nullopt;
  }
  Quantity q = read_quantity(node.scalar, spec.unit);
  if (!q.value) {
    complain(node.where, key, q.problem, q.reason, q.suggestion);
    return std::nullopt;
  }
  return in_range(key, node, *q.value, spec) ? q.value : std::nullopt;
}

void YamlSchema::number(const char* key, double& value, KeySpec spec) {
  if (const InputEntry* entry = look_up(key, spec, sample(spec)))
    if (const auto read = quantity(key, entry->value, spec)) value = *read;
}

void YamlSchema::number(const char* key, std::optional<double>& value, KeySpec spec) {
  if (const InputEntry* entry = look_up(key, spec, sample(spec)))
    if (const auto read = quantity(key, entry->value, spec)) value = *read;
}

void YamlSchema::integer(const char* key, std::int64_t& value, KeySpec spec) {
  const InputNode* node = scalar(key, spec, "a whole number", "10");
  if (!node) return;
  const std::string& text = node->scalar;
  const char* begin = text.c_str() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.c_str() + text.size();
  const std::size_t sign = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
  std::int64_t read = 0;
  const auto [stop, error] = std::from_chars(begin, end, read);
  if (error == std::errc::result_out_of_range) {
    complain(node->where, key, "is " + node->describe(), "too large", "write a smaller number");
  } else if (error != std::errc{} || stop != end) {
    complain(node->where, key, "is " + node->describe(), "a whole number is needed",
             "write digits only, as in 10");
  } else if (text.size() > sign + 1 && text[sign] == '0') {
    complain(node->where, key, "is " + node->describe(),
             "a number with a leading zero is octal to some readers and decimal to others",
             fmt::format("write '{}'", read));
  } else if (double as_number = static_cast<double>(read); in_range(key, *node, as_number, spec)) {
    value = read;
  }
}

void YamlSchema::flag(const char* key, bool& value, KeySpec spec) {
  const InputNode* node = scalar(key, spec, "true or false", "true");
  if (!node) return;
  if (node->scalar == "true" || node->scalar == "false")
    value = node->scalar == "true";
  else
    complain(node->where, key, "is " + node->describe(), "true or false is needed", "write true or false");
}

void YamlSchema::text(const char* key, std::string& value, KeySpec spec) {
  if (const InputNode* node = scalar(key, spec, "text", *spec.example ? spec.example : "text"))
    value = node->scalar;
}

void YamlSchema::texts(const char* key, std::vector<std::string>& value, KeySpec spec) {
  const InputNode* node = items(key, spec, "a list of words", *spec.example ? spec.example : "[one, two]");
  if (!node) return;
  value.clear();
  for (const InputNode& item : node->list) {
    if (item.kind == Kind::scalar)
      value.push_back(item.scalar);
    else
      complain(item.where, key, "has an item that is " + item.describe(), "words are needed",
               "write [one, two]");
  }
}

void YamlSchema::file(const char* key, fs::path& value, KeySpec spec) {
  const InputNode* node = scalar(key, spec, "a file name", *spec.example ? spec.example : "folder/file");
  if (!node) return;
  const fs::path path = fs::absolute(fs::path(node->folder) / node->scalar).lexically_normal();
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored)) {
    value = path;
    return;
  }
  if (fs::is_directory(path, ignored)) {
    complain(node->where, key, fmt::format("names the folder '{}'", node->scalar), "a file is needed",
             "name a file in it");
    return;
  }
  std::vector<std::string> neighbours;
  for (const auto& entry : fs::directory_iterator(path.parent_path(), ignored))
    neighbours.push_back(entry.path().filename().string());
  std::sort(neighbours.begin(), neighbours.end());
  const std::string near = nearest_word(path.filename().string(), neighbours);
  complain(node->where, key, fmt::format("names '{}', which is not there", node->scalar),
           fmt::format("looked for {}", path.string()),
           near.empty() ? "the path is relative to the file that names it"
                        : fmt::format("did you mean '{}'?", near));
}

bool YamlSchema::read_vector(const char* key, Vec3& value, const KeySpec& spec) {
  const std::string example = *spec.example ? spec.example : fmt::format("[{0}, {0}, {0}]", sample(spec));
  const InputNode* node = items(key, spec, "a list [x, y, z]", example);
  if (!node) return false;
  if (node->list.size() != 3) {
    complain(node->where, key, fmt::format("has {} items", node->list.size()), "[x, y, z] is needed",
             fmt::format("write '{}: {}'", key, example));
    return false;
  }
  Vec3 read = Vec3::Zero();
  bool good = true;
  for (int k = 0; k < 3; ++k) {
    const auto component = quantity(key, node->list[static_cast<std::size_t>(k)], spec);
    good = good && component;
    if (component) read[k] = *component;
  }
  if (good) value = read;
  return good;
}

void YamlSchema::vector(const char* key, Vec3& value, KeySpec spec) {
  read_vector(key, value, spec);
}

void YamlSchema::vector(const char* key, std::optional<Vec3>& value, KeySpec spec) {
  Vec3 read = Vec3::Zero();
  if (read_vector(key, read, spec)) value = read;
}

void YamlSchema::numbers(const char* key, std::vector<double>& value, KeySpec spec) {
  const InputNode* node = items(key, spec, "a list of numbers",
                                *spec.example ? spec.example : fmt::format("[{0}, {0}]", sample(spec)));
  if (!node) return;
  std::vector<double> all;
  for (const InputNode& item : node->list)
    if (const auto read = quantity(key, item, spec)) all.push_back(*read);
  if (all.size() == node->list.size()) value = std::move(all);
}

void YamlSchema::choose(const char* key, std::size_t& index, const std::vector<std::string>& words,
                        KeySpec spec) {
  const InputNode* node = scalar(key, spec, fmt::format("one of {}", fmt::join(words, ", ")), words.front());
  if (!node) {
    kind_unclear_ = kind_unclear_ || given(key) || spec.required;
    return;
  }
  const auto found = std::find(words.begin(), words.end(), node->scalar);
  if (found != words.end()) {
    index = static_cast<std::size_t>(found - words.begin());
    return;
  }
  kind_unclear_ = true;
  const std::string near = nearest_word(node->scalar, words);
  complain(node->where, key, "is " + node->describe(),
           fmt::format("one of {} is needed", fmt::join(words, ", ")),
           near.empty() ? "" : fmt::format("did you mean '{}'?", near));
}

void YamlSchema::visit_mapping(const InputEntry& entry, const Visit& visit) {
  YamlSchema inner(entry, problems_);
  visit(inner);
  inner.report_unknown();
}

bool YamlSchema::one_section(const char* key, KeySpec spec, const Visit& visit) {
  const InputEntry* entry = look_up(key, spec, *spec.example ? spec.example : "{...}");
  if (!entry) return false;
  if (entry->value.kind != Kind::mapping) {
    complain(entry->value.where, key, "is " + entry->value.describe(), "a section with keys is needed",
             "write its keys below it, indented");
    return false;
  }
  visit_mapping(*entry, visit);
  return true;
}

bool YamlSchema::many(const char* key, bool by_name, KeySpec spec, const VisitNamed& visit) {
  const std::string form = by_name ? "names, each with a section below it," : "a list of sections";
  const InputEntry* entry =
      look_up(key, spec, *spec.example ? spec.example : (by_name ? "{name: {...}}" : "[{...}]"));
  if (!entry) return false;
  const Kind wanted = by_name ? Kind::mapping : Kind::list;
  if (entry->value.kind != wanted) {
    complain(entry->value.where, key, "is " + entry->value.describe(), form + " is needed",
             by_name ? "write 'name:' and its keys below it, indented" : "begin each item with '- '");
    return false;
  }
  std::vector<InputEntry> list;
  for (const InputNode& item : entry->value.list) list.push_back({key, item.where, item});
  for (const InputEntry& item : by_name ? entry->value.mapping : list) {
    if (item.value.kind == Kind::mapping)
      visit_mapping(item, [&](Schema& s) { visit(s, item.key); });
    else
      complain(item.where, item.key, "is " + item.value.describe(), "a section with keys is needed",
               "write its keys below it, indented");
  }
  return true;
}

}  // namespace sluice
