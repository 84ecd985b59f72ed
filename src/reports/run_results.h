#pragma once
/// A run folder, read.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/csv.h"
#include "output/run_folder.h"
#include "output/run_manifest.h"
#include "output/view.h"

namespace sluice {

struct RunResults {
  RunFolder folder;
  RunManifest manifest;
  std::optional<CsvTable> series, exits, mixing, walls;  ///< absent where the run wrote none
  std::optional<View> view;

  std::string title() const;  ///< of the process, or its file, or the folder
};

/// @throws EnvironmentError  no run.json;  InputError  a damaged file
RunResults read_results(const std::filesystem::path& run_folder);

/// Rows of exits.csv of one exit, in order of their bins.
struct ExitDistribution {
  std::string exit;
  std::vector<double> edges;  ///< of the bins, along the width [m]; one more than bins
  std::vector<std::size_t> rows;
};
std::vector<ExitDistribution> exit_distributions(const CsvTable& exits);

/// Values of a column in the rows of one exit, times `factor`, over the bin's width if `per_metre`.
enum class PerWidth { whole_bin, per_metre };
std::vector<double> exit_values(const CsvTable& exits, const ExitDistribution& exit,
                                const std::string& column, double factor, PerWidth per);

}  // namespace sluice
