#pragma once
/// Every key that a struct declares, as data: what `sluice explain` prints and the JSON Schema is made of.
///
///   const std::vector<KeyEntry> keys = process_keys<ProcessConfig>();

#include <string>
#include <vector>

#include "base/schema.h"

namespace sluice {

struct KeyEntry {
  enum class Type { number, integer, flag, text, texts, file, vector, numbers, choice, section, list, named };

  std::string key;   ///< "bore"
  std::string path;  ///< "pipes.<name>.bore"; an item of a list is "layers.<n>.depth"
  Type type = Type::text;
  std::string unit;           ///< SI; "" = plain
  bool required = false;      ///< where it applies
  std::string default_value;  ///< in words; "" = none
  std::string range;          ///< in words; "" = any
  std::string doc;
  std::string applies_to;  ///< "" = always
  std::string example;
  double at_least = 0, above = 0, at_most = 0, below = 0;  ///< in `unit`; infinite = no bound
  std::vector<std::string> words;                          ///< of a choice
  std::vector<KeyEntry> children;                          ///< of a section, list or named
};

/// Collects what a struct declares; its fields keep their defaults.
class KeyCollector : public Schema {
 public:
  explicit KeyCollector(std::string prefix = "") : prefix_(std::move(prefix)) {}
  std::vector<KeyEntry> take() { return std::move(entries_); }

  void number(const char* key, double& value, KeySpec spec) override;
  void number(const char* key, std::optional<double>& value, KeySpec spec) override;
  void integer(const char* key, std::int64_t& value, KeySpec spec) override;
  void flag(const char* key, bool& value, KeySpec spec) override;
  void text(const char* key, std::string& value, KeySpec spec) override;
  void texts(const char* key, std::vector<std::string>& value, KeySpec spec) override;
  void file(const char* key, std::filesystem::path& value, KeySpec spec) override;
  void vector(const char* key, Vec3& value, KeySpec spec) override;
  void vector(const char* key, std::optional<Vec3>& value, KeySpec spec) override;
  void numbers(const char* key, std::vector<double>& value, KeySpec spec) override;

  Location here() const override { return {}; }
  Location at(const char*) const override { return {}; }
  bool given(const char*) const override { return false; }
  /// Nothing was read, so a check of the struct's own has nothing to say.
  void problem(const char*, std::string, std::string, std::string) override {}

 protected:
  void choose(const char* key, std::size_t& index, const std::vector<std::string>& words,
              KeySpec spec) override;
  bool one_section(const char* key, KeySpec spec, const Visit& visit) override;
  bool many(const char* key, bool by_name, KeySpec spec, const VisitNamed& visit) override;

 private:
  KeyEntry& add(const char* key, KeyEntry::Type type, const KeySpec& spec, std::string default_value);

  std::string prefix_;
  std::vector<KeyEntry> entries_;
};

template <class T>
std::vector<KeyEntry> keys_of() {
  T root{};
  KeyCollector collector;
  root.keys(collector);
  return collector.take();
}

/// `extends`, which every process file has and no struct declares.
KeyEntry extends_key();

/// The keys of a process file whose root is T.
template <class T>
std::vector<KeyEntry> process_keys() {
  std::vector<KeyEntry> keys = keys_of<T>();
  keys.insert(keys.begin(), extends_key());
  return keys;
}

/// All keys, a paragraph each, in the order in which they are declared.
std::string explain_all(const std::vector<KeyEntry>& keys);

/// One key and what is below it. The query is a path; names and list places may be left out, and so
/// may the beginning: "pipes.left.bore", "pipes.bore" and "bore" find the same.
/// @throws InputError with the nearest keys if there is none
std::string explain_one(const std::vector<KeyEntry>& keys, const std::string& query);

/// JSON Schema (draft 2020-12) for editors. A file that extends another may leave required keys out.
std::string json_schema(const std::vector<KeyEntry>& keys, const std::string& title);

}  // namespace sluice
