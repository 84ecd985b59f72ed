#include "processes/study_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "processes/process_document.h"

namespace sluice {

namespace {

void check_assignments(Schema& s, const std::vector<std::string>& set) {
  for (const std::string& assignment : set)
    if (assignment.find('=') == std::string::npos || assignment.front() == '=')
      s.problem("set", fmt::format("has '{}'", assignment), "an assignment is needed",
                "write [water.spacing=40 mm]");
}

}  // namespace

void VariationConfig::keys(Schema& s) {
  where = s.here();
  s.text("title", title, {.doc = "of the variation, as the page shows it; without it, its name"});
  s.file("process", process, {.doc = "process file; without it, that of the study"});
  s.texts("set", set,
          {.doc = "key=value over the process file, as --set has it",
           .example = "[conveyors.feed.rate=1650 t/h]"});
  check_assignments(s, set);
  set_at = s.given("set") ? s.at("set") : s.here();
}

void ClaimConfig::keys(Schema& s) {
  where = s.here();
  s.text("text", text, {.required = true, .doc = "the claim in a sentence"});
  s.text("result", result,
         {.required = true,
          .doc = "what it is about, by its name in study.csv",
          .example = "deck_apertures.water_cov_across_width"});
  s.choice("kind", kind, {{"lower", Kind::lower}, {"alike", Kind::alike}},
           {.required = true,
            .doc = "lower: the result of 'of' lies below that of 'against'; alike: they differ by "
                   "less than 'margin'"});
  s.text("of", of, {.required = true, .doc = "one of 'variations'"});
  s.text("against", against, {.required = true, .doc = "another of 'variations'"});
  s.number("margin", margin,
           {.above = 0,
            .doc = "largest difference, as a share of the result of 'against'",
            .applies = kind == Kind::alike,
            .applies_to = "kind: alike",
            .example = "10 %"});
  of_at = s.at("of");
  against_at = s.at("against");
}

void StudyConfig::keys(Schema& s) {
  where = s.here();
  s.text("title", title, {.required = true, .doc = "of the study, as the page shows it"});
  s.file("process", process, {.doc = "process file of the variations that name none"});
  s.text("until", until,
         {.doc = "simulated time at which every run ends; without it, the process's duration",
          .example = "6 s"});
  s.texts("set", set,
          {.doc = "key=value over the process file, for all variations", .example = "[water.spacing=80 mm]"});
  s.numbers(
      "seeds", seeds,
      {.at_least = 0,
       .doc = "each variation runs once with each: repetitions whose scatter gives the limits; without them, "
              "once with the process's own",
       .example = "[1, 2, 3, 4, 5]"});
  s.named("variations", variations, {.required = true, .doc = "what is compared"});
  s.named("claims", claims, {.doc = "statements that the page judges; they need five seeds"});
  set_at = s.given("set") ? s.at("set") : s.here();
  check_assignments(s, set);
  if (s.given("variations") && variations.size() < 2)
    s.problem("variations", fmt::format("has {} entry", variations.size()), "two at least can be compared",
              "add another");
  for (std::size_t k = 0; k < seeds.size(); ++k)
    if (seeds[k] != std::floor(seeds[k]) || std::count(seeds.begin(), seeds.end(), seeds[k]) > 1) {
      s.problem("seeds", fmt::format("has {:g}", seeds[k]), "whole numbers, each once, are needed",
                "write [1, 2, 3, 4, 5]");
      break;
    }
  for (const VariationConfig& v : variations)
    if (process_of(v).empty())
      s.problem("process", fmt::format("is missing, and variation '{}' names none", v.name), "",
                "add 'process: FILE.yaml'");
}

StudyConfig read_study(const std::filesystem::path& file) {
  ProcessDocument document = ProcessDocument::read(file);
  StudyConfig study = document.as<StudyConfig>();
  std::vector<std::string> names;
  for (const VariationConfig& v : study.variations) names.push_back(v.name);
  for (const ClaimConfig& claim : study.claims) {
    const auto check = [&](const char* key, const std::string& name, const Location& at) {
      if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
        document.add(
            {at, key, fmt::format("is '{}'", name), "not one of 'variations'", suggest_word(name, names)});
    };
    check("of", claim.of, claim.of_at);
    check("against", claim.against, claim.against_at);
    if (!claim.of.empty() && claim.of == claim.against)
      document.add(
          {claim.against_at, "against", "is the same variation", "two are compared", "name another"});
  }
  if (!study.until.empty() && !read_quantity(study.until, "s").value)
    document.add(
        {study.where, "until", fmt::format("is '{}'", study.until), "a time is needed", "write 6 s"});
  document.finish();
  return study;
}

}  // namespace sluice
