#pragma once
/// An extreme case: `validation/extremes/NAME.yaml`, a process and a ladder of one hard setting.
///
///   title: Contact stiffness over six decades
///   group: rocks
///   scene: scenes/pit.yaml             a process file
///   set: [rocks.bed_depth=0.1 m]       on every rung
///   vary: [rocks.stiffness_per_size]   keys that a rung sets, or `step_over_limit`
///   over: [{at: 1e4 N/m2, expect: stops}, {at: 1e5 N/m2}, ...]      from easy to hard
///   remedy: [rocks.stiffness_per_size=1e6 N/m2]       what the message of a stop says; must then run
///   default: 2.7e6 N/m2                what a user gets without asking
///   expect: ...                        a sentence: what is to be expected, and why
///
/// `step_over_limit` makes the step that share of the critical step: rocks' network limit or h / (c + v).

#include <filesystem>
#include <string>
#include <vector>

#include "base/schema.h"
#include "output/extremes_record.h"

namespace sluice {

struct ExtremeSetting {
  std::string at;                 ///< with unit
  std::vector<std::string> with;  ///< further key=value of this rung
  ExtremeOutcome expect = ExtremeOutcome::runs;
  bool quick = false;  ///< part of `--quick`
  double number = 0;   ///< of `at`, in the unit as written
  void keys(Schema& s);
};

struct ExtremeConfig {
  std::string title, group, expect, standard;
  std::filesystem::path scene;
  std::vector<std::string> set, vary, remedy;
  std::vector<ExtremeSetting> over;
  void keys(Schema& s);
};

struct Extreme {
  std::string name;  ///< of its file
  ExtremeConfig config;
};

inline constexpr const char* step_over_limit = "step_over_limit";

/// @throws InputError, EnvironmentError
Extreme read_extreme(const std::filesystem::path& file);
/// Files below `root`, by name. @throws EnvironmentError if there is no root
std::vector<std::filesystem::path> extreme_files(const std::filesystem::path& root);

}  // namespace sluice
