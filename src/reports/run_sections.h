#pragma once
/// The sections of a run's page, each from what the run folder holds. An empty body = leave it out.

#include "reports/page_shell.h"
#include "reports/run_results.h"

namespace sluice {

PageSection summary_section(const RunResults& run);
PageSection picture_section(const RunResults& run);
PageSection view_section(const RunResults& run);
PageSection exit_section(const RunResults& run);
PageSection series_section(const RunResults& run);
PageSection mixing_section(const RunResults& run);
PageSection wall_section(const RunResults& run);
PageSection budget_section(const RunResults& run);
PageSection trust_section(const RunResults& run);
PageSection cost_section(const RunResults& run);
PageSection provenance_section(const RunResults& run);

/// The series as JSON for the script; empty if the run has none.
std::string series_json(const CsvTable& series);

}  // namespace sluice
