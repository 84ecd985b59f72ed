#pragma once
/// The commands of the program; each returns an exit code or throws one of base/errors.h.

#include <filesystem>
#include <string>
#include <vector>

namespace sluice {

struct RunOptions {
  std::filesystem::path process;
  std::filesystem::path out;  ///< empty: out/ + the process file's stem
  int threads = 0;            ///< 0: all
  std::string until;          ///< with unit; empty: the process's duration
  bool resume = false;
  bool whole = false;  ///< to its end, whatever `stop` says
  std::vector<std::string> overrides;
};
int run_process(const RunOptions& options);

struct CheckOptions {
  std::filesystem::path process;
  std::vector<std::string> overrides;
};
int check_process(const CheckOptions& options);

struct ExplainOptions {
  std::string key;
  bool schema = false;
  bool study = false;  ///< keys of a study instead of a process
};
int explain_keys(const ExplainOptions& options);

struct ReportOptions {
  std::vector<std::filesystem::path> runs;
  std::filesystem::path out;
};
int report_runs(const ReportOptions& options);

/// A process over a ladder of settings of one key.
struct ConvergeOptions {
  std::filesystem::path process;
  std::string vary;           ///< path of the key
  std::string over;           ///< settings, coarse to fine, with commas between
  std::filesystem::path out;  ///< empty: out/ + the process file's stem and the key
  int threads = 0;            ///< 0: all
  std::string until;          ///< with unit; empty: the process's duration
  std::vector<std::string> overrides;
};
int converge_process(const ConvergeOptions& options);

/// A process x variations.
struct StudyOptions {
  std::filesystem::path study;
  std::filesystem::path out;  ///< empty: out/ + the study file's stem
  int threads = 0;            ///< 0: all
  std::string until;          ///< with unit; empty: as the study says
  std::vector<std::string> overrides;
};
int run_study(const StudyOptions& options);

/// Textbook cases of `validation/`, up their ladders.
struct ValidateOptions {
  std::vector<std::string> names;  ///< of cases; empty: all
  std::filesystem::path cases = "validation";
  std::filesystem::path out;  ///< empty: reports/ for everything, out/validation for a part
  std::string rung;           ///< one rung of one case, by its setting
  std::vector<std::string> scene_keys;
  int threads = 0;  ///< 0: all
  bool quick = false, list = false;
  bool update = false;    ///< renews these cases in the record that `out` has already
  bool extremes = false;  ///< those of `validation/extremes/` instead
};
int validate_cases(const ValidateOptions& options);
/// How far each extreme case goes before it stops: a frontier.
int validate_extremes(const ValidateOptions& options);

/// Exit code where a case of `sluice validate` misses its gate.
inline constexpr int gate_failed = 5;

}  // namespace sluice
