#pragma once
/// A study: variations of a process, seeds, and what is claimed of them. All keys of a study file.

#include <filesystem>
#include <string>
#include <vector>

#include "base/schema.h"

namespace sluice {

/// One entry of `variations:`.
struct VariationConfig {
  std::string name, title;
  std::filesystem::path process;  ///< empty: the study's
  std::vector<std::string> set;
  Location where, set_at;
  void keys(Schema& s);
};

/// One entry of `claims:`.
struct ClaimConfig {
  enum class Kind { lower, alike };
  std::string name, text, result, of, against;
  Kind kind = Kind::lower;
  double margin = 0.1;
  Location where, of_at, against_at;
  void keys(Schema& s);
};

struct StudyConfig {
  std::string title;
  std::filesystem::path process;
  std::string until;
  std::vector<std::string> set;
  std::vector<double> seeds;
  std::vector<VariationConfig> variations;
  std::vector<ClaimConfig> claims;
  Location where, set_at;
  void keys(Schema& s);

  const std::filesystem::path& process_of(const VariationConfig& v) const {
    return v.process.empty() ? process : v.process;
  }
};

/// @throws InputError with everything that is wrong; EnvironmentError where the file is not there
StudyConfig read_study(const std::filesystem::path& file);

}  // namespace sluice
