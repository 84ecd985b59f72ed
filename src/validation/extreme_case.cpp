#include "validation/extreme_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "processes/process_document.h"

namespace sluice {

namespace fs = std::filesystem;

void ExtremeSetting::keys(Schema& s) {
  s.text("at", at, {.required = true, .doc = "setting of the varied keys"});
  s.texts("with", with, {.doc = "further key=value that belong to this rung"});
  s.choice("expect", expect,
           {{"runs", ExtremeOutcome::runs},
            {"stops", ExtremeOutcome::stops},
            {"refused", ExtremeOutcome::refused}},
           {.doc = "whether it runs, stops with exit code 3, or is refused with exit code 2"});
  s.flag("quick", quick, {.doc = "whether `--quick` runs it too"});
  if (std::from_chars(at.data(), at.data() + at.size(), number).ec != std::errc{}) number = 0;
}

void ExtremeConfig::keys(Schema& s) {
  constexpr std::array<const char*, 3> groups{"rocks", "water", "coupling"};
  s.text("title", title, {.required = true, .doc = "what is made extreme"});
  s.text("group", group, {.required = true, .doc = "rocks, water or coupling"});
  s.file("scene", scene, {.required = true, .doc = "process file"});
  s.texts("set", set, {.doc = "key=value of the process, on every rung"});
  s.texts("vary", vary, {.required = true, .doc = "keys of the process that a rung sets"});
  s.list("over", over, {.required = true, .doc = "rungs from easy to hard"});
  s.texts("remedy", remedy, {.doc = "key=value that the message of a stop asks for; must run"});
  s.text("default", standard, {.doc = "setting that a user gets without asking, in the rungs' unit"});
  s.text("expect", expect, {.required = true, .doc = "what is to be expected, and why"});
  if (!group.empty() && std::find(groups.begin(), groups.end(), group) == groups.end())
    s.problem("group", fmt::format("is '{}'", group), fmt::format("one of {}", fmt::join(groups, ", ")), "");
  if (over.empty()) s.problem("over", "has no rung", "a frontier needs a ladder", "add rungs");
  const bool stops = std::any_of(over.begin(), over.end(),
                                 [](const ExtremeSetting& r) { return r.expect == ExtremeOutcome::stops; });
  if (stops && remedy.empty())
    s.problem("remedy", "is missing", "a rung is expected to stop", "give what its message asks for");
}

Extreme read_extreme(const fs::path& file) {
  ProcessDocument document = ProcessDocument::read(file);
  Extreme read{file.stem().string(), document.as<ExtremeConfig>()};
  document.finish();
  return read;
}

std::vector<fs::path> extreme_files(const fs::path& root) {
  std::error_code error;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(root, error))
    if (entry.path().extension() == ".yaml") found.push_back(entry.path());
  if (error)
    throw EnvironmentError(
        fmt::format("{} cannot be read ({}); run from the folder that holds it, or name the cases' folder "
                    "with --cases",
                    root.string(), error.message()));
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace sluice
