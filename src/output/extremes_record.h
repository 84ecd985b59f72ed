#pragma once
/// What came of the extreme cases: how far each goes, and what happens beyond.

#include <optional>
#include <string>
#include <vector>

namespace sluice {

/// What a rung of a hard ladder may do. `broken` is never right: a crash, lost mass, a number that is none.
enum class ExtremeOutcome { runs, stops, refused, broken };
const char* outcome_word(ExtremeOutcome outcome);

struct ExtremeRung {
  std::string setting;  ///< of the varied key, with unit
  double number = 0;    ///< the same as a number
  ExtremeOutcome expected = ExtremeOutcome::runs, outcome = ExtremeOutcome::broken;
  std::string message;                ///< of the stop, the refusal or what broke; else what was cut short
  std::vector<std::string> warnings;  ///< what `sluice check` says beforehand
  std::string remedy;                 ///< setting that was tried after a stop; empty: none was
  bool remedy_named = true;           ///< the message names that key
  bool remedy_works = true;           ///< with it, the rung runs
  double simulated = 0;               ///< [s]
  double steps = 0, seconds = 0;      ///< of the scene; of run time
  double overlap = 0;                 ///< largest, percent of the radius
  double created = 0;                 ///< energy of rocks from nowhere, percent of all
  double mach = 0;                    ///< fastest water over the speed of sound
  std::string command;                ///< that runs this rung alone

  bool good() const {
    return outcome == expected && outcome != ExtremeOutcome::broken && remedy_named && remedy_works;
  }
};

struct ExtremeCase {
  std::string name, title, group, vary, expect, scene;
  std::string default_words;             ///< setting that a user gets without asking; empty: none
  std::optional<double> default_number;  ///< the same as a number
  std::vector<ExtremeRung> rungs;        ///< easy to hard
  bool good() const;
  /// The last rung that ran before the first that did not; null if none ran.
  const ExtremeRung* frontier() const;
  /// The first rung that did not run; null if all did.
  const ExtremeRung* beyond() const;
  /// "from 0.2 (default) to 1.1: a factor of 5.5", in words.
  std::string margin() const;
};

struct ExtremesRecord {
  std::string version, commit, compiler, flags, cpu, command;
  int threads = 0;
  double seconds = 0;
  std::vector<ExtremeCase> cases;
  bool good() const;
};

}  // namespace sluice
