// converge.json and study.json.
#include "output/json_text.h"
#include "output/run_series.h"

namespace sluice {

namespace {

std::string made_by_json(const SeriesProvenance& p) {
  return json_object({{"version", json_string(p.version)},
                      {"commit", json_string(p.commit)},
                      {"compiler", json_string(p.compiler)},
                      {"flags", json_string(p.flags)},
                      {"cpu", json_string(p.cpu)},
                      {"threads", json_number(p.threads)},
                      {"command", json_string(p.command)}});
}

JsonMembers limits_json(double value, double half_width) {
  return {{"value", json_number(value)},
          {"low95", json_number(value - half_width)},
          {"high95", json_number(value + half_width)}};
}

std::string row_json(const SeriesRow& row, const char* label) {
  JsonMembers j = {{label, json_string(row.label)}};
  if (row.seed)
    j.emplace_back("seed", json_number(static_cast<double>(*row.seed)));
  else
    j.emplace_back("setting", json_number(row.setting));
  j.insert(j.end(), {{"folder", json_string(row.folder.string())},
                     {"command", json_string(row.command)},
                     {"outcome", json_string(row.outcome)},
                     {"message", json_string(row.message)},
                     {"commit", json_string(row.commit)},
                     {"state_hash", json_string(row.state_hash)},
                     {"run_time_s", json_number(row.run_time)},
                     {"simulated_s", json_number(row.simulated)},
                     {"dt_rock_s", json_number(row.rock_step)},
                     {"dt_fluid_s", json_number(row.water_step)},
                     {"rocks_max", json_number(row.rocks)},
                     {"water_points_max", json_number(row.water_points)},
                     {"peak_bytes", json_number(row.memory)}});
  JsonMembers results;
  for (const KeyResult& r : row.results) {
    JsonMembers one = limits_json(r.value, r.half_width);
    one.emplace_back("steady", json_flag(r.steady));
    one.emplace_back("reason", json_string(r.reason));
    results.emplace_back(r.name, json_object(one));
  }
  j.emplace_back("results", json_object(results, JsonForm::lines));
  return json_object(j, JsonForm::lines);
}

std::string change_json(const ConvergeRecord& record, const std::string& result) {
  std::vector<std::string> changes;
  for (std::size_t k = 1; k < record.rungs.size(); ++k) {
    const Change c = *record.change(k, result);
    changes.push_back(json_object({{"from", json_string(record.rungs[k - 1].label)},
                                   {"to", json_string(record.rungs[k].label)},
                                   {"change", json_number(c.value)},
                                   {"low95", json_number(c.value - c.half_width)},
                                   {"high95", json_number(c.value + c.half_width)},
                                   {"verdict", json_string(word_of(c.verdict))}}));
  }
  std::string extrapolation = "null";
  if (const auto e = record.extrapolation(result))
    extrapolation = json_object({{"order", json_number(e->order)},
                                 {"value", json_number(e->value)},
                                 {"grid_convergence_index", json_number(e->index)}});
  return json_object({{"changes", json_array(changes, JsonForm::lines)}, {"extrapolation", extrapolation}},
                     JsonForm::lines);
}

std::string claim_json(const StudyClaim& c) {
  JsonMembers j = {{"text", json_string(c.text)},
                   {"result", json_string(c.result)},
                   {"of", json_string(c.first)},
                   {"against", json_string(c.other)},
                   {"kind", json_string(c.kind == ClaimKind::lower ? "lower" : "alike")},
                   {"margin", c.kind == ClaimKind::alike ? json_number(c.margin) : "null"},
                   {"verdict", json_string(word_of(c.outcome.verdict))},
                   {"reference", json_number(c.outcome.reference)}};
  for (auto& member : limits_json(c.outcome.difference.value, c.outcome.difference.half_width))
    j.emplace_back(member.first == "value" ? "difference" : member.first, member.second);
  return json_object(j, JsonForm::lines);
}

}  // namespace

std::string converge_json(const ConvergeRecord& record) {
  std::vector<std::string> rungs;
  for (const SeriesRow& row : record.rungs) rungs.push_back(row_json(row, "rung"));
  JsonMembers results;
  for (const KeyResult& result : record.results())
    results.emplace_back(result.name, change_json(record, result.name));
  return json_object({{"sluice", made_by_json(record.made_by)},
                      {"process", json_string(record.process)},
                      {"title", json_string(record.title)},
                      {"vary", json_string(record.vary)},
                      {"notes", json_strings(record.notes)},
                      {"rungs", json_array(rungs, JsonForm::lines)},
                      {"results", json_object(results, JsonForm::lines)}},
                     JsonForm::lines) +
         "\n";
}

std::string study_json(const StudyRecord& record) {
  std::vector<std::string> claims, runs;
  for (const StudyClaim& c : record.claims) claims.push_back(claim_json(c));
  for (const SeriesRow& row : record.runs) runs.push_back(row_json(row, "variation"));
  JsonMembers variations;
  for (const std::string& variation : record.variations) {
    JsonMembers results;
    for (const KeyResult& result : record.results()) {
      const Estimate e = record.estimate(variation, result.name);
      results.emplace_back(result.name, json_object(limits_json(e.value, e.half_width)));
    }
    variations.emplace_back(variation, json_object(results, JsonForm::lines));
  }
  return json_object({{"sluice", made_by_json(record.made_by)},
                      {"study", json_string(record.file)},
                      {"title", json_string(record.title)},
                      {"notes", json_strings(record.notes)},
                      {"claims", json_array(claims, JsonForm::lines)},
                      {"variations", json_object(variations, JsonForm::lines)},
                      {"runs", json_array(runs, JsonForm::lines)}},
                     JsonForm::lines) +
         "\n";
}

}  // namespace sluice
