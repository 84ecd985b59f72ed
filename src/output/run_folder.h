#pragma once
/// Where a run keeps its files, and how they are written so that a reader never sees half of one.
///
///   RUN_DIR/  run.json  series.csv  exits.csv  mixing.csv  walls.csv  view.json  report.html
///             frames/  checkpoint.h5  checkpoint.previous.h5

#include <filesystem>
#include <string>
#include <string_view>

namespace sluice {

struct RunFolder {
  std::filesystem::path root;

  std::filesystem::path manifest() const { return root / "run.json"; }
  std::filesystem::path series() const { return root / "series.csv"; }
  std::filesystem::path exits() const { return root / "exits.csv"; }
  std::filesystem::path mixing() const { return root / "mixing.csv"; }
  std::filesystem::path walls() const { return root / "walls.csv"; }
  std::filesystem::path view() const { return root / "view.json"; }
  std::filesystem::path report() const { return root / "report.html"; }
  std::filesystem::path frames() const { return root / "frames"; }
  std::filesystem::path checkpoint() const { return root / "checkpoint.h5"; }
  std::filesystem::path previous_checkpoint() const { return root / "checkpoint.previous.h5"; }
};

enum class FolderUse {
  fresh,   ///< results of an earlier run in the folder are removed; other files are left alone
  resume,  ///< they are kept
};

/// Makes the folder (with parents) and tries to write in it.
/// @throws EnvironmentError  with the reason of the operating system
RunFolder open_run_folder(const std::filesystem::path& root, FolderUse use);

/// Writes next to the file, flushes to disk, then renames: the old or the new content, never half.
/// @throws EnvironmentError  with the reason of the operating system
void write_atomically(const std::filesystem::path& file, std::string_view content);

/// Renames a finished temporary file over `file`, flushed to disk. @throws EnvironmentError
void replace_file(const std::filesystem::path& temporary, const std::filesystem::path& file);

/// The whole file. @throws EnvironmentError  if it is not there or cannot be read
std::string read_whole_file(const std::filesystem::path& file);

/// What is wrong with a file that was to be read.
struct FileProblem {
  std::string problem, reason, suggestion;
  int line = 0;  ///< from 1, 0 = unknown
};
/// @throws InputError  always
[[noreturn]] void refuse_file(const std::filesystem::path& file, const FileProblem& problem);

}  // namespace sluice
