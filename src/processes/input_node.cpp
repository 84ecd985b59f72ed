#include "processes/input_node.h"

#include <fmt/format.h>

#include <algorithm>

namespace sluice {

const InputEntry* InputNode::find(std::string_view key) const {
  const auto found =
      std::find_if(mapping.begin(), mapping.end(), [&](const auto& e) { return e.key == key; });
  return found == mapping.end() ? nullptr : &*found;
}

InputEntry* InputNode::find(std::string_view key) {
  return const_cast<InputEntry*>(std::as_const(*this).find(key));
}

std::string InputNode::describe() const {
  constexpr std::size_t longest = 60;  // of a text that a message shows
  switch (kind) {
    case Kind::null:
      return "empty";
    case Kind::scalar:
      return fmt::format("'{}{}'", scalar.substr(0, longest), scalar.size() > longest ? " ..." : "");
    case Kind::list:
      return "a list";
    case Kind::mapping:
      return "a section";
  }
  return "";
}

InputNode merged(InputNode base, InputNode over) {
  if (base.kind != InputNode::Kind::mapping || over.kind != InputNode::Kind::mapping) return over;
  for (InputEntry& entry : over.mapping) {
    if (InputEntry* old = base.find(entry.key)) {
      old->value = merged(std::move(old->value), std::move(entry.value));
      old->where = entry.where;
    } else {
      base.mapping.push_back(std::move(entry));
    }
  }
  base.where = over.where;
  base.folder = over.folder;
  return base;
}

namespace {

/// Optimal string alignment distance (Damerau-Levenshtein without repeated edits of one place).
std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] =
          std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

}  // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& words) {
  std::string best;
  std::size_t fewest = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : words) {
    const std::size_t edits = edits_between(word, candidate);
    if (edits < fewest) {
      fewest = edits;
      best = candidate;
    }
  }
  return best;
}

std::string suggest_word(std::string_view word, const std::vector<std::string>& words) {
  const std::string nearest = nearest_word(word, words);
  if (!nearest.empty()) return fmt::format("did you mean '{}'?", nearest);
  if (words.empty() || words.size() > 16) return "";
  return fmt::format("use {}{}", words.size() > 1 ? "one of " : "", fmt::join(words, ", "));
}

}  // namespace sluice
