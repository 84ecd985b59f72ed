#pragma once
/// series.csv: one row per report time, appended and flushed as the run goes.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sluice {

class SeriesWriter {
 public:
  /// @param columns  named with unit; the first is "time_s"
  /// @param resume_time  rows later than this [s] are dropped and the rest kept; without it the file
  ///        starts anew
  /// @throws EnvironmentError  disk;  InputError  a resumed file with other columns
  SeriesWriter(const std::filesystem::path& file, std::vector<std::string> columns,
               std::optional<double> resume_time);

  /// @param values  one per column, values[0] the time [s]; NaN = empty cell. @throws EnvironmentError
  void append(const std::vector<double>& values);
  const std::vector<std::string>& columns() const { return columns_; }

 private:
  std::filesystem::path file_;
  std::vector<std::string> columns_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream_;
};

}  // namespace sluice
