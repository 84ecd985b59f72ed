#include "output/validation_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/run_folder.h"

namespace sluice {

namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\u{:04x}", static_cast<int>(c));
    else
      out += c;
  }
  return out + '"';
}

std::string number_or_null(double x) {
  return std::isfinite(x) ? fmt::format("{:.9g}", x) : "null";
}
std::string number_or_null(const std::optional<double>& x) {
  return x ? number_or_null(*x) : "null";
}

std::string rung_json(const ValidationRung& r) {
  std::string values;
  for (const ValidationValue& v : r.values)
    values += fmt::format("{}\n       {{\"what\": {}, \"measured\": {}, \"reference\": {}}}",
                          values.empty() ? "" : ",", quoted(v.what), number_or_null(v.measured),
                          number_or_null(v.reference));
  return fmt::format(
      "     {{\"setting\": {}, \"number\": {}, \"error\": {}, \"gate\": {}, \"passed\": {}, \"stable\": {}, "
      "\"message\": {},\n      \"seconds\": {}, \"particle_steps\": {}, \"ns_per_particle_step\": {}, "
      "\"command\": {},\n      \"values\": [{}]}}",
      quoted(r.setting), number_or_null(r.number), number_or_null(r.error), number_or_null(r.gate),
      r.passed(), r.stable, quoted(r.message), number_or_null(r.seconds), number_or_null(r.particle_steps),
      number_or_null(r.nanoseconds()), quoted(r.command), values);
}

std::string case_json(const ValidationCase& c) {
  std::string rungs;
  for (const ValidationRung& r : c.rungs) rungs += (rungs.empty() ? "\n" : ",\n") + rung_json(r);
  return fmt::format(
      "  {{\"name\": {}, \"title\": {}, \"group\": {}, \"passed\": {}, \"norm\": {}, \"vary\": {}, "
      "\"particle\": {},\n   \"source\": {},\n   \"shortfall\": {},\n   \"order\": {}, \"least_order\": {}, "
      "\"whole_ladder\": {},\n"
      "   \"rungs\": [{}]}}",
      quoted(c.name), quoted(c.title), quoted(c.group), c.passed(), quoted(c.norm), quoted(c.vary),
      quoted(c.particle), quoted(c.source), quoted(c.shortfall), number_or_null(c.order),
      number_or_null(c.least_order), c.whole(), rungs);
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

std::string validation_json(const ValidationRecord& record) {
  std::string cases;
  for (const ValidationCase& c : record.cases) cases += (cases.empty() ? "\n" : ",\n") + case_json(c);
  return fmt::format(
      "{{\n \"sluice\": {{\"version\": {}, \"commit\": {}, \"compiler\": {}, \"flags\": {}}},\n"
      " \"machine\": {{\"threads\": {}, \"cpu\": {}}},\n \"command\": {},\n \"passed\": {},\n"
      " \"cases\": [{}]\n}}\n",
      quoted(record.version), quoted(record.commit), quoted(record.compiler), quoted(record.flags),
      record.threads, quoted(record.cpu), quoted(record.command), record.passed(), cases);
}

void write_validation_json(const std::filesystem::path& file, const ValidationRecord& record) {
  write_atomically(file, validation_json(record));
}

}  // namespace sluice
