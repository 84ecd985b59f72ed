#include <fmt/format.h>

#include "app/commands.h"
#include "reports/comparison_page.h"
#include "reports/run_page.h"

namespace sluice {

int report_runs(const ReportOptions& options) {
  if (options.runs.size() == 1 && options.out.empty()) {
    write_run_page(options.runs.front());
    fmt::print("page: {}\n", (options.runs.front() / "report.html").string());
    return 0;
  }
  const std::filesystem::path out =
      options.out.empty() ? std::filesystem::path("comparison.html") : options.out;
  write_comparison_page(options.runs, out);
  fmt::print("page: {}\n", out.string());
  return 0;
}

}  // namespace sluice
