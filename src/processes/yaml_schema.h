#pragma once
/// The schema that reads a process file: every key checked, every problem collected with its place.

#include <functional>
#include <string>
#include <vector>

#include "base/schema.h"
#include "base/units.h"
#include "processes/input_node.h"

namespace sluice {

class YamlSchema : public Schema {
 public:
  /// Reads the mapping of `section`; both arguments must outlive this.
  YamlSchema(const InputEntry& section, std::vector<InputProblem>& problems)
      : section_(section), problems_(problems) {}

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

  Location here() const override { return section_.where; }
  Location at(const char* key) const override;
  bool given(const char* key) const override { return section_.value.find(key) != nullptr; }
  void problem(const char* key, std::string problem, std::string reason, std::string suggestion) override;

  /// Adds a problem for every key of the mapping that no call above has asked for.
  void report_unknown();

  static constexpr const char* missing = "is missing";  ///< the problem that is reported last

 protected:
  void choose(const char* key, std::size_t& index, const std::vector<std::string>& words,
              KeySpec spec) override;
  bool one_section(const char* key, KeySpec spec, const Visit& visit) override;
  bool many(const char* key, bool by_name, KeySpec spec, const VisitNamed& visit) override;

 private:
  /// The entry of a key that is there and applies; null otherwise, after saying what is wrong.
  const InputEntry* look_up(const char* key, const KeySpec& spec, const std::string& example);
  /// The same, and a scalar (or list) it must be.
  const InputNode* scalar(const char* key, const KeySpec& spec, const std::string& needed,
                          const std::string& example);
  const InputNode* items(const char* key, const KeySpec& spec, const std::string& needed,
                         const std::string& example);
  /// A quantity in range, or nothing after saying what is wrong.
  std::optional<double> quantity(const char* key, const InputNode& node, const KeySpec& spec);
  /// True if in range; a value within a rounding of a bound becomes the bound.
  bool in_range(const char* key, const InputNode& node, double& value, const KeySpec& spec);
  bool read_vector(const char* key, Vec3& value, const KeySpec& spec);
  void visit_mapping(const InputEntry& entry, const Visit& visit);
  void complain(const Location& where, std::string key, std::string problem, std::string reason,
                std::string suggestion) {
    problems_.push_back(
        {where, std::move(key), std::move(problem), std::move(reason), std::move(suggestion)});
  }

  const InputEntry& section_;
  std::vector<InputProblem>& problems_;
  std::vector<std::string> known_;
  bool kind_unclear_ = false;  ///< a choice could not be read, so what applies is not known
};

/// The range of a key in words: "above 0 m, at most 2 m"; "" where there is none.
std::string range_words(const KeySpec& spec);

}  // namespace sluice
