#include "app/process_source.h"

#include "base/sha256.h"
#include "base/units.h"
#include "output/run_folder.h"
#include "processes/process_document.h"
#include "sluice_version.h"

namespace sluice {

ProcessSource read_process_source(const std::filesystem::path& file,
                                  const std::vector<std::string>& overrides) {
  ProcessDocument document = ProcessDocument::read(file, overrides);
  ProcessSource source;
  source.config = document.as<ProcessConfig>();
  document.finish();
  source.file = file;
  std::string all;
  for (const std::filesystem::path& part : document.files()) all += read_whole_file(part) + '\0';
  for (const std::string& set : overrides) all += set + '\0';
  source.sha256 = sha256(all);
  return source;
}

double end_of_run(const ProcessConfig& config, const std::string& text) {
  if (text.empty()) return config.duration;
  const Quantity until = read_quantity(text, "s");
  if (!until.value || !(*until.value > 0))
    throw InputError(InputProblem{{"--until", 0, 0},
                                  "until",
                                  until.value ? "is not positive" : until.problem,
                                  until.reason,
                                  until.suggestion.empty() ? "write --until '2 s'" : until.suggestion});
  return *until.value;
}

std::string program_name() {
  return std::string("sluice ") + program_version + " (" + program_commit + ")";
}

}  // namespace sluice
