#pragma once
/// One key, one line: a configuration struct declares each of its keys once,
///
///   struct PipeJet {
///     double bore = 0;            ///< [m]
///     Profile profile = Profile::flat;
///     void keys(Schema& s) {
///       s.number("bore", bore, {.unit = "m", .required = true, .above = 0, .doc = "inner diameter"});
///       s.choice("profile", profile, {{"flat", Profile::flat}, {"turbulent", Profile::turbulent}},
///                {.doc = "velocity over the bore"});
///     }
///   };
///
/// and the same declaration reads a process file, converts units, checks ranges, finds unknown keys,
/// explains (`sluice explain`) and prints the JSON Schema. The value a field holds before reading is
/// its default. Keys that belong to one kind of thing are declared always, with
/// `.applies = kind == Kind::pipe, .applies_to = "kind: pipe"`: given elsewhere they are an error.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "base/vec.h"

namespace sluice {

struct KeySpec {
  const char* unit = "";  ///< SI unit of the field; "" = a plain number
  bool required = false;
  double at_least = -std::numeric_limits<double>::infinity();
  double above = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();
  double below = std::numeric_limits<double>::infinity();
  const char* doc = "";
  bool applies = true;          ///< false: giving the key is an error
  const char* applies_to = "";  ///< when the key applies, in words ("kind: pipe")
  const char* example = "";     ///< shown by `sluice explain`
};

class Schema {
 public:
  virtual ~Schema() = default;

  virtual void number(const char* key, double& value, KeySpec spec) = 0;
  virtual void number(const char* key, std::optional<double>& value, KeySpec spec) = 0;
  virtual void integer(const char* key, std::int64_t& value, KeySpec spec) = 0;
  virtual void flag(const char* key, bool& value, KeySpec spec) = 0;
  virtual void text(const char* key, std::string& value, KeySpec spec) = 0;
  virtual void texts(const char* key, std::vector<std::string>& value, KeySpec spec) = 0;
  /// A file named relative to the process file; made absolute. It must exist.
  virtual void file(const char* key, std::filesystem::path& value, KeySpec spec) = 0;
  /// [x, y, z], each with the unit; "[1 m, 2 m, 0 m]".
  virtual void vector(const char* key, Vec3& value, KeySpec spec) = 0;
  virtual void vector(const char* key, std::optional<Vec3>& value, KeySpec spec) = 0;
  virtual void numbers(const char* key, std::vector<double>& value, KeySpec spec) = 0;

  /// One of several words.
  template <class E>
  void choice(const char* key, E& value, std::initializer_list<std::pair<const char*, E>> words,
              KeySpec spec) {
    std::vector<std::string> names;
    std::size_t index = 0;
    for (const auto& [name, e] : words) {
      if (e == value) index = names.size();
      names.emplace_back(name);
    }
    choose(key, index, names, spec);
    value = (words.begin() + static_cast<std::ptrdiff_t>(index))->second;
  }

  /// A nested mapping; T has `void keys(Schema&)`.
  template <class T>
  void section(const char* key, T& value, KeySpec spec) {
    one_section(key, spec, [&](Schema& s) { value.keys(s); });
  }
  /// A nested mapping that may be absent.
  template <class T>
  void section(const char* key, std::optional<T>& value, KeySpec spec) {
    spec.required = false;
    T read{};
    if (value) read = *value;
    if (one_section(key, spec, [&](Schema& s) { read.keys(s); })) value = std::move(read);
  }
  /// A list of mappings.
  template <class T>
  void list(const char* key, std::vector<T>& value, KeySpec spec) {
    std::vector<T> all;
    const bool there = many(key, false, spec, [&](Schema& s, const std::string&) {
      T read{};
      read.keys(s);
      all.push_back(std::move(read));
    });
    if (there) value = std::move(all);
  }
  /// A mapping from names to mappings, in file order; T has a `name`.
  template <class T>
  void named(const char* key, std::vector<T>& value, KeySpec spec) {
    std::vector<T> all;
    const bool there = many(key, true, spec, [&](Schema& s, const std::string& name) {
      T read{};
      read.name = name;
      read.keys(s);
      all.push_back(std::move(read));
    });
    if (there) value = std::move(all);
  }

  /// Where the mapping being read stands, or one of its keys (for checks that compare keys).
  virtual Location here() const = 0;
  virtual Location at(const char* key) const = 0;
  /// True if the mapping being read has this key.
  virtual bool given(const char* key) const = 0;
  /// Adds a problem found by a check of the struct's own; reading goes on.
  virtual void problem(const char* key, std::string problem, std::string reason, std::string suggestion) = 0;

 protected:
  using Visit = std::function<void(Schema&)>;
  using VisitNamed = std::function<void(Schema&, const std::string& name)>;
  virtual void choose(const char* key, std::size_t& index, const std::vector<std::string>& words,
                      KeySpec spec) = 0;
  /// Returns true if the section was there.
  virtual bool one_section(const char* key, KeySpec spec, const Visit& visit) = 0;
  /// Returns true if the list was there.
  virtual bool many(const char* key, bool by_name, KeySpec spec, const VisitNamed& visit) = 0;
};

}  // namespace sluice
