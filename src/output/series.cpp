#include "output/series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/errors.h"
#include "output/csv.h"
#include "output/run_folder.h"

namespace sluice {
namespace {

/// What is kept of an earlier part of the run: rows up to `time` [s].
CsvTable kept_rows(const std::filesystem::path& file, const std::vector<std::string>& columns, double time) {
  // a run that was killed may have left half a row
  std::string text = read_whole_file(file);
  text.resize(text.rfind('\n') + 1);
  CsvTable table = parse_csv(text, file);
  if (table.columns != columns)
    refuse_file(file, {"has other columns than this run writes", "the process or the program changed",
                       "start anew in another folder"});
  const std::vector<double> times = table.numbers(columns.front());
  // a row written at the checkpoint's own time belongs to the past; the margin is for its decimal form
  const double limit = time + 1e-12 * std::max(1.0, std::abs(time));
  const auto late = std::find_if_not(times.begin(), times.end(), [&](double t) { return t <= limit; });
  table.rows.resize(static_cast<std::size_t>(late - times.begin()));
  return table;
}

}  // namespace

SeriesWriter::SeriesWriter(const std::filesystem::path& file, std::vector<std::string> columns,
                           std::optional<double> resume_time)
    : file_(file), columns_(std::move(columns)), stream_(nullptr, &std::fclose) {
  CsvTable table;
  table.columns = columns_;
  if (resume_time && std::filesystem::exists(file)) table = kept_rows(file, columns_, *resume_time);
  write_csv(file, table);
  stream_.reset(std::fopen(file.c_str(), "ab"));
  if (!stream_)
    throw EnvironmentError(fmt::format("{}: cannot be written ({})", file.string(), std::strerror(errno)));
}

void SeriesWriter::append(const std::vector<double>& values) {
  if (values.size() != columns_.size())
    throw std::logic_error(
        fmt::format("{}: {} values for {} columns", file_.string(), values.size(), columns_.size()));
  const std::string line = csv_line({values.begin(), values.end()});
  if (std::fwrite(line.data(), 1, line.size(), stream_.get()) != line.size() ||
      std::fflush(stream_.get()) != 0)
    throw EnvironmentError(fmt::format("{}: cannot be written ({})", file_.string(), std::strerror(errno)));
}

}  // namespace sluice
