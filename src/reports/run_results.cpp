#include "reports/run_results.h"

#include <algorithm>
#include <cmath>

namespace sluice {
namespace {

std::optional<CsvTable> table_if_there(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  return read_csv(file);
}

}  // namespace

std::string RunResults::title() const {
  if (!manifest.process.title.empty()) return manifest.process.title;
  if (!manifest.process.file.empty()) return std::filesystem::path(manifest.process.file).filename().string();
  return folder.root.filename().string();
}

RunResults read_results(const std::filesystem::path& run_folder) {
  RunResults r;
  r.folder = RunFolder{run_folder};
  r.manifest = read_manifest(r.folder.manifest());
  r.series = table_if_there(r.folder.series());
  r.exits = table_if_there(r.folder.exits());
  r.mixing = table_if_there(r.folder.mixing());
  r.walls = table_if_there(r.folder.walls());
  if (std::filesystem::exists(r.folder.view())) r.view = read_view(r.folder.view());
  return r;
}

std::vector<ExitDistribution> exit_distributions(const CsvTable& exits) {
  const std::vector<std::string> names = exits.texts("exit");
  const std::vector<double> from = exits.numbers("from_m"), to = exits.numbers("to_m");
  std::vector<ExitDistribution> out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    auto found = std::find_if(out.begin(), out.end(), [&](const auto& e) { return e.exit == names[i]; });
    if (found == out.end()) found = out.insert(out.end(), ExitDistribution{names[i], {}, {}});
    const double lower = i < from.size() ? from[i] : std::nan(""),
                 upper = i < to.size() ? to[i] : std::nan("");
    if (!std::isfinite(lower) || !std::isfinite(upper) || upper <= lower) continue;
    if (found->edges.empty()) found->edges.push_back(lower);
    found->edges.push_back(upper);
    found->rows.push_back(i);
  }
  return out;
}

std::vector<double> exit_values(const CsvTable& exits, const ExitDistribution& exit,
                                const std::string& column, double factor, PerWidth per) {
  const std::vector<double> all = exits.numbers(column);
  std::vector<double> out;
  for (std::size_t k = 0; k < exit.rows.size(); ++k) {
    const double width = per == PerWidth::per_metre ? exit.edges[k + 1] - exit.edges[k] : 1;
    out.push_back(all.empty() ? std::nan("") : all[exit.rows[k]] * factor / width);
  }
  return out;
}

}  // namespace sluice
