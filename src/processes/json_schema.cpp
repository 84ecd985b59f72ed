#include <fmt/format.h>

#include <cmath>

#include "base/units.h"
#include "processes/key_list.h"

namespace sluice {
namespace {

using Type = KeyEntry::Type;

enum class Completeness {
  whole,  ///< required keys must be there
  part,   ///< the file extends another, which may hold them
};

std::string quoted(const std::string& text) {
  std::string s = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      s += std::string("\\") + c;
    else if (static_cast<unsigned char>(c) < 0x20)
      s += fmt::format("\\u{:04x}", static_cast<int>(c));
    else
      s += c;
  }
  return s + "\"";
}

/// A JSON object written member by member.
class Object {
 public:
  Object& raw(const std::string& key, const std::string& json) {
    body_ += fmt::format("{}{}: {}", body_.empty() ? "" : ", ", quoted(key), json);
    return *this;
  }
  Object& text(const std::string& key, const std::string& value) { return raw(key, quoted(value)); }
  Object& members(const std::string& more) {
    if (!more.empty()) body_ += (body_.empty() ? "" : ", ") + more;
    return *this;
  }
  const std::string& body() const { return body_; }
  std::string json() const { return "{" + body_ + "}"; }

 private:
  std::string body_;
};

// A decimal number without leading zeros, as read_quantity takes it; a unit begins with a letter, %, ( or 1/.
constexpr const char* decimal = R"(^\s*[-+]?(?=[.0-9])(?:0|[1-9][0-9]*)?(?:\.[0-9]*)?(?:[eE][-+]?[0-9]+)?)";

std::string bounds(const KeyEntry& entry) {
  Object o;
  const auto bound = [&](const char* name, double value) {
    if (std::isfinite(value)) o.raw(name, fmt::format("{}", value));
  };
  bound("minimum", entry.at_least);
  bound("exclusiveMinimum", entry.above);
  bound("maximum", entry.at_most);
  bound("exclusiveMaximum", entry.below);
  return o.body();
}

std::string number(const KeyEntry& entry) {
  if (!entry.unit.empty())
    return Object()
        .text("type", "string")
        .text("pattern", std::string(decimal) + R"(\s*(?:[A-Za-z%(]|1/|[^ -~]).*$)")
        .json();
  const std::string plain = Object().text("type", "number").members(bounds(entry)).json();
  const std::string share =
      Object().text("type", "string").text("pattern", std::string(decimal) + R"(\s*%$)").json();
  return Object().raw("anyOf", fmt::format("[{}, {}]", plain, share)).json();
}

std::string object(const std::vector<KeyEntry>& keys, Completeness completeness);

Object value_schema(const KeyEntry& entry, Completeness completeness) {
  Object o;
  switch (entry.type) {
    case Type::number: {
      const std::string json = number(entry);
      return o.members(json.substr(1, json.size() - 2));
    }
    case Type::integer:
      return o.text("type", "integer").members(bounds(entry));
    case Type::flag:
      return o.text("type", "boolean");
    case Type::text:
      return o.raw("type", R"(["string", "number"])");
    case Type::file:
      return o.text("type", "string");
    case Type::texts:
      return o.text("type", "array").raw("items", R"({"type": ["string", "number"]})");
    case Type::vector:
      return o.text("type", "array").raw("items", number(entry)).raw("minItems", "3").raw("maxItems", "3");
    case Type::numbers:
      return o.text("type", "array").raw("items", number(entry));
    case Type::choice: {
      std::string words;
      for (const std::string& word : entry.words) words += (words.empty() ? "" : ", ") + quoted(word);
      return o.raw("enum", "[" + words + "]");
    }
    case Type::section: {
      const std::string json = object(entry.children, completeness);
      return o.members(json.substr(1, json.size() - 2));
    }
    case Type::list:
      // An item is never merged with one of another file: it must be whole.
      return o.text("type", "array").raw("items", object(entry.children, Completeness::whole));
    case Type::named:
      return o.text("type", "object").raw("additionalProperties", object(entry.children, completeness));
  }
  return o;
}

std::string description(const KeyEntry& entry) {
  std::string s = entry.doc;
  const auto add = [&](const std::string& more) { s += (s.empty() ? "" : "; ") + more; };
  if (!entry.unit.empty())
    add(fmt::format("{} ({})", describe_unit(entry.unit).noun, describe_unit(entry.unit).examples));
  if (!entry.range.empty()) add(entry.range);
  if (!entry.default_value.empty()) add("default " + entry.default_value);
  if (!entry.applies_to.empty()) add("only with " + entry.applies_to);
  return s;
}

std::string object(const std::vector<KeyEntry>& keys, Completeness completeness) {
  Object properties;
  std::string required;
  for (const KeyEntry& entry : keys) {
    Object schema = value_schema(entry, completeness);
    schema.text("description", description(entry));
    if (!entry.example.empty()) schema.raw("examples", "[" + quoted(entry.example) + "]");
    properties.raw(entry.key, schema.json());
    // What is required for one kind only is left to `sluice check`.
    if (entry.required && entry.applies_to.empty() && completeness == Completeness::whole)
      required += (required.empty() ? "" : ", ") + quoted(entry.key);
  }
  Object o;
  o.text("type", "object").raw("properties", properties.json()).raw("additionalProperties", "false");
  if (!required.empty()) o.raw("required", "[" + required + "]");
  return o.json();
}

}  // namespace

std::string json_schema(const std::vector<KeyEntry>& keys, const std::string& title) {
  return Object()
             .text("$schema", "https://json-schema.org/draft/2020-12/schema")
             .text("title", title)
             .raw("if", R"({"required": ["extends"]})")
             .raw("then", object(keys, Completeness::part))
             .raw("else", object(keys, Completeness::whole))
             .json() +
         "\n";
}

}  // namespace sluice
