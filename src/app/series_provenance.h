#pragma once
/// Who made a series of runs, and on what.

#include <string>

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

}  // namespace sluice
