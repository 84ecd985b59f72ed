#pragma once
/// Who made a series of runs, and on what.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/summary.h"
#include "base/parallel.h"
#include "output/run_series.h"
#include "sluice_version.h"

namespace sluice {

/// @param threads  asked for; 0 = all
inline SeriesProvenance series_provenance(std::string command, int threads) {
  return {program_version,
          program_commit,
          program_compiler,
          program_flags,
          processor_name(),
          std::move(command),
          threads > 0 ? threads : thread_count()};
}

/// Says it where the runs were not made by the program that writes the page, or not by one.
inline std::vector<std::string> build_notes(const std::vector<SeriesRow>& runs) {
  std::vector<std::string> commits;
  for (const SeriesRow& row : runs)
    if (!row.commit.empty() && std::find(commits.begin(), commits.end(), row.commit) == commits.end())
      commits.push_back(row.commit);
  if (commits.size() > 1)
    return {fmt::format("the runs were made by different builds: {}", fmt::join(commits, ", "))};
  if (commits.size() == 1 && commits.front() != program_commit)
    return {fmt::format("the runs were made by build {}, this page by build {}", commits.front(),
                        program_commit)};
  return {};
}

}  // namespace sluice
