#include "processes/find_key.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

namespace sluice {

namespace {

std::vector<std::string> words_of(const std::string& path) {
  std::vector<std::string> words;
  std::istringstream stream(path);
  for (std::string word; std::getline(stream, word, '.');) words.push_back(word);
  return words;
}

const KeyEntry* entry_named(const std::vector<KeyEntry>& entries, const std::string& key) {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const auto& e) { return e.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

std::vector<std::string> names_of(const std::vector<KeyEntry>& entries) {
  std::vector<std::string> names;
  for (const KeyEntry& e : entries) names.push_back(e.key);
  return names;
}

/// Sections whose defaults are at work in a scene that does not write them.
bool works_unwritten(const std::string& section) {
  return section == "coupling" || section == "output";
}

}  // namespace

const KeyEntry* find_key(const std::vector<KeyEntry>& keys, const std::string& path) {
  const std::vector<std::string> words = words_of(path);
  const std::vector<KeyEntry>* level = &keys;
  const KeyEntry* entry = nullptr;
  for (std::size_t k = 0; k < words.size(); ++k) {
    entry = entry_named(*level, words[k]);
    if (!entry) return nullptr;
    // The name or the place in a list stands between an entry and its keys.
    if ((entry->type == KeyEntry::Type::named || entry->type == KeyEntry::Type::list) && k + 1 < words.size())
      ++k;
    level = &entry->children;
  }
  return entry;
}

std::vector<InputProblem> misnamed_key(const ProcessDocument& scene, const std::vector<KeyEntry>& keys,
                                       const std::string& path, const Location& where) {
  const std::vector<std::string> words = words_of(path);
  if (words.empty() || path.front() == '.' || path.back() == '.' || path.find("..") != std::string::npos)
    return {{where, path, "is not the path of a key", "", "write section.key, such as water.spacing"}};
  const std::vector<KeyEntry>* level = &keys;
  const InputNode* node = &scene.root();
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::string so_far =
        fmt::format("{}", fmt::join(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(k), "."));
    const KeyEntry* entry = entry_named(*level, words[k]);
    if (!entry)
      return {{where, words[k], "is not a key", so_far.empty() ? "of a process" : "of '" + so_far + "'",
               suggest_word(words[k], names_of(*level))}};
    if (k + 1 == words.size()) {
      if (entry->children.empty()) return {};
      return {{where, path, "is a section", "one key with one value is needed",
               suggest_word("", names_of(entry->children))}};
    }
    if (entry->children.empty())
      return {{where, path, "is not a key", fmt::format("'{}' has no keys of its own", words[k]), ""}};
    const InputEntry* written = node ? node->find(words[k]) : nullptr;
    if (!written && !(k == 0 && works_unwritten(words[k])))
      return {{where, words[k], "is not in this scene", "the process has no such section",
               node ? "vary a key of a section that it has" : ""}};
    node = written ? &written->value : nullptr;
    level = &entry->children;
    if (entry->type != KeyEntry::Type::named && entry->type != KeyEntry::Type::list) continue;
    ++k;
    if (entry->type == KeyEntry::Type::named) {
      std::vector<std::string> names;
      for (const InputEntry& e : node->mapping) names.push_back(e.key);
      const InputEntry* item = node->find(words[k]);
      if (!item)
        return {{where, words[k], "is not in this scene", fmt::format("none of its '{}'", words[k - 1]),
                 suggest_word(words[k], names)}};
      node = &item->value;
    } else {
      std::size_t index = node->list.size();
      const std::string& word = words[k];
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
      if (error != std::errc{} || end != word.data() + word.size() || index >= node->list.size())
        return {{where, word, "is not an item of this list",
                 fmt::format("it has {} items, counted from 0", node->list.size()), ""}};
      node = &node->list[index];
    }
    if (k + 1 == words.size()) return {{where, path, "is a section", "one key with one value is needed", ""}};
  }
  return {};
}

}  // namespace sluice
