#pragma once
/// A process file as a tree that knows where everything stands: what lies between the YAML parser and
/// the schema, and where `extends` and `--set` do their work.

#include <string>
#include <utility>
#include <vector>

#include "base/errors.h"

namespace sluice {

struct InputEntry;

struct InputNode {
  enum class Kind { null, scalar, list, mapping };

  Kind kind = Kind::null;
  Location where;                   ///< of the value
  std::string folder;               ///< of the file it stands in; files it names are relative to this
  std::string scalar;               ///< text of a scalar
  bool quoted = false;              ///< scalar in quotes: a word even where it looks like a number
  std::vector<InputNode> list;      ///< items of a list
  std::vector<InputEntry> mapping;  ///< in file order, keys unique

  const InputEntry* find(std::string_view key) const;
  InputEntry* find(std::string_view key);
  /// "a list", "a section", "'25 mm'", "empty"
  std::string describe() const;
};

struct InputEntry {
  std::string key;
  Location where;  ///< of the key
  InputNode value;
};

/// `base` with the entries of `over` put in: mappings are merged key by key, all else is replaced.
InputNode merged(InputNode base, InputNode over);

/// The word of `words` nearest to `word` in edits (insert, delete, change, swap of neighbours), or ""
/// where none is near enough to be meant.
std::string nearest_word(std::string_view word, const std::vector<std::string>& words);

/// "did you mean 'bore'?", or the words themselves where none is near, or "".
std::string suggest_word(std::string_view word, const std::vector<std::string>& words);

}  // namespace sluice
