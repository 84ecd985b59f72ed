#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <span>
#include <sstream>

#include "base/units.h"
#include "processes/input_node.h"
#include "processes/key_list.h"

namespace sluice {
namespace {

using Type = KeyEntry::Type;

/// "a length (m, mm or in)", "one of pipe, spray", ...
std::string value_words(const KeyEntry& entry) {
  const UnitWords unit = describe_unit(entry.unit);
  const std::string with_units =
      entry.unit.empty() ? unit.noun : fmt::format("{} ({})", unit.noun, unit.examples);
  switch (entry.type) {
    case Type::number:
      return with_units;
    case Type::integer:
      return "a whole number";
    case Type::flag:
      return "true or false";
    case Type::text:
      return "text";
    case Type::texts:
      return "a list of words";
    case Type::file:
      return "a file name, relative to the file it stands in";
    case Type::vector:
      return "[x, y, z], each " + with_units;
    case Type::numbers:
      return "a list, each " + with_units;
    case Type::choice:
      return fmt::format("one of {}", fmt::join(entry.words, ", "));
    case Type::section:
      return "a section";
    case Type::list:
      return "a list of sections";
    case Type::named:
      return "names, each with a section";
  }
  return "";
}

std::string facts(const KeyEntry& entry) {
  std::string s = value_words(entry);
  if (!entry.range.empty()) s += "; " + entry.range;
  if (entry.required)
    s += "; required";
  else if (!entry.default_value.empty())
    s += "; default " + entry.default_value;
  if (!entry.applies_to.empty()) s += "; only with " + entry.applies_to;
  return s;
}

void visit_all(const std::vector<KeyEntry>& keys, const std::function<void(const KeyEntry&)>& visit) {
  for (const KeyEntry& entry : keys) {
    visit(entry);
    visit_all(entry.children, visit);
  }
}

std::string paragraph(const KeyEntry& entry) {
  std::string s = fmt::format("{}\n    {}\n", entry.path, facts(entry));
  if (!entry.doc.empty()) s += fmt::format("    {}\n", entry.doc);
  return s;
}

std::string table(const KeyEntry& entry) {
  std::string s = entry.path + "\n";
  const auto row = [&](const char* name, const std::string& text) {
    if (!text.empty()) s += fmt::format("  {:<9} {}\n", name, text);
  };
  row("meaning", entry.doc);
  row("value", value_words(entry));
  row("range", entry.range);
  row("default", entry.required ? "none: it is required" : entry.default_value);
  row("only with", entry.applies_to);
  if (!entry.example.empty()) row("example", fmt::format("{}: {}", entry.key, entry.example));
  return s;
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> words;
  std::istringstream stream(path);
  for (std::string word; std::getline(stream, word, '.');) words.push_back(word);
  return words;
}

using Words = std::span<const std::string>;

/// A placeholder ("<name>") stands for one word of the query or for none.
bool matches(Words path, Words query) {
  if (path.empty()) return query.empty();
  if (path.front().starts_with('<'))
    return matches(path.subspan(1), query) || (!query.empty() && matches(path.subspan(1), query.subspan(1)));
  return !query.empty() && path.front() == query.front() && matches(path.subspan(1), query.subspan(1));
}

bool ends_with(const std::vector<std::string>& path, const std::vector<std::string>& query) {
  for (std::size_t start = 1; !query.empty() && start < path.size(); ++start)
    if ((!path[start].starts_with('<') || path[start] == query.front()) &&
        matches(Words(path).subspan(start), query))
      return true;
  return false;
}

}  // namespace

std::string explain_all(const std::vector<KeyEntry>& keys) {
  std::string s;
  visit_all(keys, [&](const KeyEntry& entry) { s += paragraph(entry); });
  return s;
}

std::string explain_one(const std::vector<KeyEntry>& keys, const std::string& query) {
  const std::vector<std::string> wanted = split(query);
  std::vector<const KeyEntry*> found, ends;
  std::vector<std::string> last_words, paths;
  visit_all(keys, [&](const KeyEntry& entry) {
    const std::vector<std::string> path = split(entry.path);
    if (matches(path, wanted)) found.push_back(&entry);
    if (ends_with(path, wanted)) ends.push_back(&entry);
    last_words.push_back(entry.key);
    std::string plain;
    for (const std::string& word : path)
      if (!word.starts_with('<')) plain += (plain.empty() ? "" : ".") + word;
    paths.push_back(std::move(plain));
  });
  if (found.empty()) found = ends;
  if (found.empty()) {
    std::string near = nearest_word(query, paths);
    if (near.empty() && !wanted.empty()) near = nearest_word(wanted.back(), last_words);
    InputProblem problem;
    problem.key = query;
    problem.problem = "is not a key";
    problem.suggestion =
        near.empty() ? "see `sluice explain` for all keys" : fmt::format("did you mean '{}'?", near);
    throw InputError(std::move(problem));
  }
  std::string s;
  for (const KeyEntry* entry : found) {
    if (!s.empty()) s += "\n";
    s += table(*entry);
    for (const KeyEntry& child : entry->children) s += "\n" + paragraph(child);
  }
  return s;
}

}  // namespace sluice
