#include "validation/case.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "processes/process_document.h"

namespace sluice {

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 5> groups{"rocks", "water", "coupling", "emitters", "analysis"};

/// Splits "20 mm" into 20 and "mm". False where it does not begin with a number.
bool split(const std::string& text, double& number, std::string& unit) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return false;
  unit = std::string(end, text.data() + text.size());
  return true;
}

}  // namespace

void Rung::keys(Schema& s) {
  s.text("at", at, {.required = true, .doc = "setting of the varied key", .example = "'20 mm'"});
  s.number("gate", gate, {.above = 0, .doc = "largest error that passes"});
}

void LadderConfig::keys(Schema& s) {
  s.text("vary", vary, {.required = true, .doc = "key of the scene that the rungs set"});
  vary_at = s.at("vary");
  s.list("rungs", rungs, {.required = true, .doc = "from coarse to fine"});
  s.integer("quick", quick, {.at_least = 0, .doc = "how many of them `--quick` runs"});
  s.number("least_order", least_order, {.doc = "observed order over the whole ladder, at least"});

  if (!rungs.empty() && rungs.size() < 3)
    s.problem("rungs", fmt::format("has {} rungs", rungs.size()), "an order shows over three", "add rungs");
  std::string first_unit;
  bool gated = least_order.has_value();
  for (std::size_t k = 0; k < rungs.size(); ++k) {
    std::string unit;
    if (!split(rungs[k].at, rungs[k].number, unit)) {
      s.problem("rungs", fmt::format("has '{}'", rungs[k].at), "a rung is a number, with its unit", "");
      return;
    }
    if (k == 0) first_unit = unit;
    if (unit != first_unit)
      s.problem("rungs", fmt::format("mixes '{}' with '{}'", rungs[0].at, rungs[k].at), "",
                "write all in one unit");
    gated = gated || rungs[k].gate;
  }
  for (std::size_t k = 2; k < rungs.size(); ++k)
    if ((rungs[k].number - rungs[k - 1].number) * (rungs[k - 1].number - rungs[k - 2].number) <= 0)
      s.problem("rungs", fmt::format("turns round at '{}'", rungs[k - 1].at), "they lead from coarse to fine",
                "sort them");
  if (!rungs.empty() && !gated)
    s.problem("rungs", "has no gate", "a case that cannot fail shows nothing", "give a rung its gate");
}

void ReferenceConfig::keys(Schema& s) {
  s.text("source", source, {.required = true, .doc = "who says so: author, year, place"});
  s.file("table", table,
         {.required = true, .doc = "CSV with the reference values", .example = "reference.csv"});
}

void CaseConfig::keys(Schema& s) {
  s.text("title", title, {.required = true, .doc = "what is compared, in a few words"});
  s.text("group", group, {.required = true, .doc = "rocks, water, coupling, emitters or analysis"});
  s.text("measure", measure, {.required = true, .doc = "how it is measured"});
  s.choice(
      "norm", norm,
      {{"largest", ErrorNorm::largest}, {"rms", ErrorNorm::rms}, {"relative_l2", ErrorNorm::relative_l2}},
      {.required = true, .doc = "how differences become one error"});
  s.section("ladder", ladder, {.required = true, .doc = "what is varied, and what passes"});
  s.section("reference", reference, {.required = true, .doc = "what it is compared with"});
  s.text("why", why, {.required = true, .doc = "one sentence: why the error is what it is"});
  s.text(
      "shortfall", shortfall,
      {.doc = "why a gate is not reached yet, for a case that is known to miss one; it fails all the same"});

  if (!group.empty() && std::find(groups.begin(), groups.end(), group) == groups.end())
    s.problem("group", fmt::format("is '{}'", group), fmt::format("one of {}", fmt::join(groups, ", ")), "");
  const MeasureKind* kind = find_measure(measure);
  if (!kind && !measure.empty()) {
    std::vector<std::string> words;
    for (const MeasureKind& k : measure_kinds()) words.emplace_back(k.word);
    s.problem("measure", fmt::format("is '{}', which is none", measure), "", suggest_word(measure, words));
  }
  if (!kind) return;
  scene = kind->make();
  s.section("scene", *scene, {.doc = "the measure's own keys"});
}

CaseConfig read_case_with(const fs::path& file, const std::vector<std::string>& scene_keys) {
  std::vector<std::string> overrides;
  for (const std::string& key : scene_keys) overrides.push_back("scene." + key);
  ProcessDocument document = ProcessDocument::read(file, overrides);
  CaseConfig config = document.as<CaseConfig>();
  document.finish();
  return config;
}

Case read_case(const fs::path& folder) {
  Case read;
  read.name = folder.filename().string();
  read.file = folder / "case.yaml";
  read.config = read_case_with(read.file, {});
  for (const Rung& rung : read.config.ladder.rungs) {
    try {
      read_case_with(read.file, {read.config.ladder.vary + "=" + rung.at});
    } catch (const InputError& e) {
      // the setting stands in the ladder, not on a command line
      InputProblem problem = e.problems().front();
      problem.where = read.config.ladder.vary_at;
      throw InputError(std::move(problem));
    }
  }
  return read;
}

std::vector<fs::path> case_folders(const fs::path& root) {
  std::error_code error;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(root, error))
    if (fs::is_regular_file(entry.path() / "case.yaml")) found.push_back(entry.path());
  if (error)
    throw EnvironmentError(
        fmt::format("{} cannot be read ({}); run from the folder that holds it, or name it "
                    "with --cases",
                    root.string(), error.message()));
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace sluice
