#pragma once
/// A schema that reads keys from maps, SI units assumed: for the checks that compare keys.

#include <map>
#include <string>
#include <vector>

#include "base/schema.h"

namespace sluice::test {

class MapSchema : public Schema {
 public:
  std::map<std::string, double> numbers_given;
  std::map<std::string, std::string> words;
  std::map<std::string, Vec3> vectors;
  std::map<std::string, std::vector<double>> number_lists;
  std::map<std::string, std::vector<MapSchema>> sections;
  std::vector<InputProblem> problems;

  void number(const char* key, double& value, KeySpec spec) override {
    if (auto at = numbers_given.find(key); look(key, spec) && at != numbers_given.end()) value = at->second;
  }
  void number(const char* key, std::optional<double>& value, KeySpec spec) override {
    if (auto at = numbers_given.find(key); look(key, spec) && at != numbers_given.end()) value = at->second;
  }
  void integer(const char* key, std::int64_t& value, KeySpec spec) override {
    if (auto at = numbers_given.find(key); look(key, spec) && at != numbers_given.end())
      value = static_cast<std::int64_t>(at->second);
  }
  void flag(const char* key, bool& value, KeySpec spec) override {
    if (auto at = words.find(key); look(key, spec) && at != words.end()) value = at->second == "true";
  }
  void text(const char* key, std::string& value, KeySpec spec) override {
    if (auto at = words.find(key); look(key, spec) && at != words.end()) value = at->second;
  }
  void texts(const char* key, std::vector<std::string>&, KeySpec spec) override { look(key, spec); }
  void file(const char* key, std::filesystem::path&, KeySpec spec) override { look(key, spec); }
  void vector(const char* key, Vec3& value, KeySpec spec) override {
    if (auto at = vectors.find(key); look(key, spec) && at != vectors.end()) value = at->second;
  }
  void vector(const char* key, std::optional<Vec3>& value, KeySpec spec) override {
    if (auto at = vectors.find(key); look(key, spec) && at != vectors.end()) value = at->second;
  }
  void numbers(const char* key, std::vector<double>& value, KeySpec spec) override {
    if (auto at = number_lists.find(key); look(key, spec) && at != number_lists.end()) value = at->second;
  }

  Location here() const override { return {"test.yaml", 1, 1}; }
  Location at(const char*) const override { return here(); }
  bool given(const char* key) const override {
    return numbers_given.count(key) + words.count(key) + vectors.count(key) + number_lists.count(key) +
               sections.count(key) >
           0;
  }
  void problem(const char* key, std::string problem, std::string reason, std::string suggestion) override {
    problems.push_back({here(), key, std::move(problem), std::move(reason), std::move(suggestion)});
  }
  /// True if a problem names this key.
  bool complains_about(const std::string& key) const {
    for (const InputProblem& p : problems)
      if (p.key == key) return true;
    return false;
  }

 protected:
  void choose(const char* key, std::size_t& index, const std::vector<std::string>& names,
              KeySpec spec) override {
    const auto at = words.find(key);
    if (!look(key, spec) || at == words.end()) return;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == at->second) index = i;
  }
  bool one_section(const char* key, KeySpec spec, const Visit& visit) override {
    const auto at = sections.find(key);
    if (!look(key, spec) || at == sections.end()) return false;
    visit(at->second.front());
    for (const InputProblem& p : at->second.front().problems) problems.push_back(p);
    return true;
  }
  bool many(const char* key, bool, KeySpec spec, const VisitNamed& visit) override {
    const auto at = sections.find(key);
    if (!look(key, spec) || at == sections.end()) return false;
    for (MapSchema& s : at->second) visit(s, "");
    return true;
  }

 private:
  /// False for a key that does not apply; then, and for a missing one, there is a problem.
  bool look(const char* key, const KeySpec& spec) {
    if (given(key) && !spec.applies) problem(key, "does not apply", spec.applies_to, "");
    if (!given(key) && spec.required && spec.applies) problem(key, "is missing", "", "");
    return spec.applies;
  }
};

}  // namespace sluice::test
