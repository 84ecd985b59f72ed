#include "processes/key_list.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/units.h"
#include "processes/yaml_schema.h"

namespace sluice {

namespace {

std::string words_of(const Vec3& v, const char* unit) {
  return fmt::format("[{}, {}, {}]", for_people(v.x(), unit), for_people(v.y(), unit),
                     for_people(v.z(), unit));
}

}  // namespace

KeyEntry& KeyCollector::add(const char* key, KeyEntry::Type type, const KeySpec& spec,
                            std::string default_value) {
  // A key may be declared once a kind of thing; it is listed once.
  const std::string path = prefix_ + key;
  for (KeyEntry& entry : entries_)
    if (entry.path == path) {
      if (*spec.applies_to && entry.applies_to.find(spec.applies_to) == std::string::npos)
        entry.applies_to += std::string(entry.applies_to.empty() ? "" : "; ") + spec.applies_to;
      return entry;
    }
  KeyEntry entry;
  entry.key = key;
  entry.path = path;
  entry.type = type;
  entry.unit = spec.unit;
  entry.required = spec.required;
  entry.default_value = spec.required ? "" : std::move(default_value);
  entry.range = range_words(spec);
  entry.doc = spec.doc;
  entry.applies_to = spec.applies_to;
  entry.example = spec.example;
  entry.at_least = spec.at_least;
  entry.above = spec.above;
  entry.at_most = spec.at_most;
  entry.below = spec.below;
  return entries_.emplace_back(std::move(entry));
}

void KeyCollector::number(const char* key, double& value, KeySpec spec) {
  add(key, KeyEntry::Type::number, spec, for_people(value, spec.unit));
}
void KeyCollector::number(const char* key, std::optional<double>& value, KeySpec spec) {
  add(key, KeyEntry::Type::number, spec, value ? for_people(*value, spec.unit) : "");
}
void KeyCollector::integer(const char* key, std::int64_t& value, KeySpec spec) {
  add(key, KeyEntry::Type::integer, spec, fmt::format("{}", value));
}
void KeyCollector::flag(const char* key, bool& value, KeySpec spec) {
  add(key, KeyEntry::Type::flag, spec, value ? "true" : "false");
}
void KeyCollector::text(const char* key, std::string& value, KeySpec spec) {
  add(key, KeyEntry::Type::text, spec, value);
}
void KeyCollector::texts(const char* key, std::vector<std::string>& value, KeySpec spec) {
  add(key, KeyEntry::Type::texts, spec, value.empty() ? "" : fmt::format("[{}]", fmt::join(value, ", ")));
}
void KeyCollector::file(const char* key, std::filesystem::path& value, KeySpec spec) {
  add(key, KeyEntry::Type::file, spec, value.string());
}
void KeyCollector::vector(const char* key, Vec3& value, KeySpec spec) {
  add(key, KeyEntry::Type::vector, spec, words_of(value, spec.unit));
}
void KeyCollector::vector(const char* key, std::optional<Vec3>& value, KeySpec spec) {
  add(key, KeyEntry::Type::vector, spec, value ? words_of(*value, spec.unit) : "");
}
void KeyCollector::numbers(const char* key, std::vector<double>& value, KeySpec spec) {
  std::vector<std::string> items;
  for (double v : value) items.push_back(for_people(v, spec.unit));
  add(key, KeyEntry::Type::numbers, spec, items.empty() ? "" : fmt::format("[{}]", fmt::join(items, ", ")));
}

void KeyCollector::choose(const char* key, std::size_t& index, const std::vector<std::string>& words,
                          KeySpec spec) {
  add(key, KeyEntry::Type::choice, spec, words[index]).words = words;
}

bool KeyCollector::one_section(const char* key, KeySpec spec, const Visit& visit) {
  KeyCollector inner(prefix_ + key + ".");
  visit(inner);
  add(key, KeyEntry::Type::section, spec, "").children = inner.take();
  return false;
}

bool KeyCollector::many(const char* key, bool by_name, KeySpec spec, const VisitNamed& visit) {
  KeyCollector inner(prefix_ + key + (by_name ? ".<name>." : ".<n>."));
  visit(inner, "");
  add(key, by_name ? KeyEntry::Type::named : KeyEntry::Type::list, spec, "").children = inner.take();
  return false;
}

KeyEntry extends_key() {
  KeyEntry entry;
  entry.key = entry.path = "extends";
  entry.type = KeyEntry::Type::text;
  entry.doc =
      "another process file, of which this one changes some keys: sections are merged, all else replaced";
  entry.example = "nozzles-1200tph.yaml";
  return entry;
}

}  // namespace sluice
