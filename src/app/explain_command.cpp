#include <fmt/format.h>

#include "app/commands.h"
#include "processes/key_list.h"
#include "processes/process_config.h"
#include "processes/study_config.h"

namespace sluice {

int explain_keys(const ExplainOptions& options) {
  const std::vector<KeyEntry> keys =
      options.study ? process_keys<StudyConfig>() : process_keys<ProcessConfig>();
  if (options.schema)
    fmt::print("{}\n", json_schema(keys, options.study ? "Sluice study" : "Sluice process"));
  else
    fmt::print("{}\n", options.key.empty() ? explain_all(keys) : explain_one(keys, options.key));
  return 0;
}

}  // namespace sluice
