#include "output/validation_record.h"

#include <fmt/format.h>

#include <algorithm>

#include "output/json_text.h"
#include "output/run_folder.h"

namespace sluice {

namespace {

std::string rung_json(const ValidationRung& r) {
  std::string values;
  for (const ValidationValue& v : r.values)
    values += fmt::format("{}\n       {{\"what\": {}, \"measured\": {}, \"reference\": {}}}",
                          values.empty() ? "" : ",", json_string(v.what), json_number(v.measured),
                          json_number(v.reference));
  return fmt::format(
      "     {{\"setting\": {}, \"number\": {}, \"error\": {}, \"gate\": {}, \"passed\": {}, \"stable\": {}, "
      "\"message\": {},\n      \"seconds\": {}, \"particle_steps\": {}, \"ns_per_particle_step\": {}, "
      "\"command\": {},\n      \"values\": [{}]}}",
      json_string(r.setting), json_number(r.number), json_number(r.error), json_number(r.gate), r.passed(),
      r.stable, json_string(r.message), json_number(r.seconds), json_number(r.particle_steps),
      json_number(r.nanoseconds()), json_string(r.command), values);
}

std::string made_by_json(const MadeBy& m) {
  return fmt::format(
      "{{\"version\": {}, \"commit\": {}, \"compiler\": {}, \"flags\": {}, \"cpu\": {}, \"threads\": {}}}",
      json_string(m.version), json_string(m.commit), json_string(m.compiler), json_string(m.flags),
      json_string(m.cpu), m.threads);
}

std::string case_json(const ValidationCase& c) {
  std::string rungs;
  for (const ValidationRung& r : c.rungs) rungs += (rungs.empty() ? "\n" : ",\n") + rung_json(r);
  return fmt::format(
      "  {{\"name\": {}, \"title\": {}, \"group\": {}, \"passed\": {}, \"norm\": {}, \"vary\": {}, "
      "\"particle\": {},\n   \"source\": {},\n   \"why\": {},\n   \"shortfall\": {},\n   \"order\": {}, "
      "\"least_order\": {}, \"whole_ladder\": {}, \"rungs_in_ladder\": {},\n   \"made_by\": {},\n"
      "   \"rungs\": [{}]}}",
      json_string(c.name), json_string(c.title), json_string(c.group), c.passed(), json_string(c.norm),
      json_string(c.vary), json_string(c.particle), json_string(c.source), json_string(c.why),
      json_string(c.shortfall), json_number(c.order), json_number(c.least_order), c.whole(),
      c.rungs_in_ladder, made_by_json(c.made_by), rungs);
}

}  // namespace

bool ValidationCase::passed() const {
  const bool rungs_pass = std::all_of(rungs.begin(), rungs.end(), [](const auto& r) { return r.passed(); });
  const bool order_passes = !whole() || !least_order || (order && *order >= *least_order);
  return rungs_pass && order_passes;
}

bool ValidationRecord::passed() const {
  return std::all_of(cases.begin(), cases.end(), [](const ValidationCase& c) { return c.passed(); });
}

bool ValidationRecord::of_one_build() const {
  return std::all_of(cases.begin(), cases.end(), [&](const auto& c) { return c.made_by == made_by; });
}

std::string validation_json(const ValidationRecord& record) {
  std::string cases;
  for (const ValidationCase& c : record.cases) cases += (cases.empty() ? "\n" : ",\n") + case_json(c);
  return fmt::format(
      "{{\n \"sluice\": {{\"version\": {}, \"commit\": {}, \"compiler\": {}, \"flags\": {}}},\n"
      " \"machine\": {{\"threads\": {}, \"cpu\": {}}},\n \"command\": {},\n \"passed\": {},\n"
      " \"cases\": [{}]\n}}\n",
      json_string(record.made_by.version), json_string(record.made_by.commit),
      json_string(record.made_by.compiler), json_string(record.made_by.flags), record.made_by.threads,
      json_string(record.made_by.cpu), json_string(record.command), record.passed(), cases);
}

void write_validation_json(const std::filesystem::path& file, const ValidationRecord& record) {
  write_atomically(file, validation_json(record));
}

}  // namespace sluice
