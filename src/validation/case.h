#pragma once
/// A validation case: `validation/NAME/case.yaml`.
///
///   title: Rebound of a sphere
///   group: rocks
///   measure: rebound                   one of measures.cpp; its keys stand under `scene`
///   scene: {end_of_contact: no_tension}
///   ladder:
///     vary: steps_per_contact          a key of the scene
///     rungs: [{at: 10, gate: 0.06}, {at: 30, gate: 0.015}, {at: 100, gate: 0.004}]    coarse to fine
///     least_order: 0.8                 observed over the whole ladder
///   norm: largest
///   reference: {source: ..., table: reference.csv}
///   why: ...                           a sentence: why the error is what it is
///   shortfall: ...                     only where a gate is not reached yet: why. It fails all the same.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/schema.h"
#include "validation/measures.h"

namespace sluice {

struct Rung {
  std::string at;              ///< setting of the varied key, with unit
  std::optional<double> gate;  ///< largest error that passes
  double number = 0;           ///< of `at`, in the unit as written
  void keys(Schema& s);
};

struct LadderConfig {
  std::string vary;
  std::vector<Rung> rungs;
  std::int64_t quick = 1;             ///< rungs that `--quick` runs
  std::optional<double> least_order;  ///< observed order, at least
  Location vary_at;                   ///< where the varied key is named
  void keys(Schema& s);
};

struct ReferenceConfig {
  std::string source;
  std::filesystem::path table;
  void keys(Schema& s);
};

struct CaseConfig {
  std::string title, group, measure, why;
  std::string shortfall;  ///< why a gate is not reached yet; empty: every gate is expected to be
  ErrorNorm norm = ErrorNorm::largest;
  LadderConfig ladder;
  ReferenceConfig reference;
  std::unique_ptr<Measure> scene;
  void keys(Schema& s);
};

struct Case {
  std::string name;            ///< of its folder
  std::filesystem::path file;  ///< case.yaml
  CaseConfig config;
};

/// Reads a case and tries its scene at every rung.
/// @throws InputError with everything that is wrong; EnvironmentError where there is no such case
Case read_case(const std::filesystem::path& folder);
/// The case with scene keys set: those of one rung, or any other, as "key=value".
CaseConfig read_case_with(const std::filesystem::path& file, const std::vector<std::string>& scene_keys);

/// Folders below `root` that hold a case.yaml, by name. @throws EnvironmentError if there is no root
std::vector<std::filesystem::path> case_folders(const std::filesystem::path& root);

}  // namespace sluice
