#pragma once
/// What a validation has to say: validation.json. Keys are added, never renamed; a number that is not
/// finite or absent becomes null.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sluice {

/// One measured number beside its reference; units are those of the case.
struct ValidationValue {
  std::string what;
  double measured = 0, reference = 0;
};

/// One rung of a case's ladder.
struct ValidationRung {
  std::string setting;         ///< of the varied key, with unit
  double number = 0;           ///< the same as a number
  double error = 0;            ///< in the case's norm; NaN where the run broke
  std::optional<double> gate;  ///< largest error that passes
  bool stable = true;          ///< ran to its end with finite values
  std::string message;         ///< why not, or what the measurement had to leave out
  double seconds = 0;          ///< of run time
  double particle_steps = 0;   ///< rocks, points or samples times steps
  std::string command;         ///< that runs this rung alone
  std::vector<ValidationValue> values;

  bool passed() const { return stable && (!gate || error <= *gate); }
  double nanoseconds() const { return particle_steps > 0 ? 1e9 * seconds / particle_steps : 0; }
};

/// Who measured, and on what.
struct MadeBy {
  std::string version, commit, compiler, flags, cpu;
  int threads = 0;
  bool operator==(const MadeBy&) const = default;
};

struct ValidationCase {
  std::string name, title, group, norm, vary, source, why;
  MadeBy made_by;
  std::string shortfall;              ///< why it is known to miss a gate; empty where it is not
  std::string particle;               ///< "rock", "point" or "sample"
  std::vector<ValidationRung> rungs;  ///< coarse to fine; only those that were run
  std::size_t rungs_in_ladder = 0;
  std::optional<double> order;        ///< observed; absent below two rungs with an error above 0
  std::optional<double> least_order;  ///< gate on it, where the whole ladder was run

  bool whole() const { return rungs.size() == rungs_in_ladder; }
  bool passed() const;
};

struct ValidationRecord {
  MadeBy made_by;       ///< the newest of the cases
  std::string command;  ///< of those
  std::vector<ValidationCase> cases;

  bool passed() const;
  bool of_one_build() const;  ///< on one machine
};

std::string validation_json(const ValidationRecord& record);
/// @throws EnvironmentError
void write_validation_json(const std::filesystem::path& file, const ValidationRecord& record);

}  // namespace sluice
