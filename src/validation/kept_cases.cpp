#include "validation/kept_cases.h"

#include <algorithm>
#include <cmath>

#include "geometry/read_text.h"
#include "processes/parse_yaml.h"

namespace sluice {

namespace {

/// JSON is YAML: the tree of the latter knows where a key is missing.
class Reader {
 public:
  explicit Reader(const InputNode& node) : node_(node) {}

  bool has(const char* key) const { return node_.find(key) != nullptr; }
  Reader at(const char* key) const { return Reader(need(key)); }
  std::string text(const char* key) const { return need(key).scalar; }
  bool flag(const char* key) const { return need(key).scalar == "true"; }
  std::optional<double> maybe(const char* key) const {
    const InputNode& value = need(key);
    if (value.kind == InputNode::Kind::null) return std::nullopt;
    const std::optional<double> number = number_of(value.scalar);
    if (!number)
      throw InputError({value.where, key, "is " + value.describe(), "a number or null is needed",
                        "run all cases again, without --update"});
    return number;
  }
  double number(const char* key) const { return maybe(key).value_or(std::nan("")); }
  std::vector<Reader> list(const char* key) const {
    std::vector<Reader> items;
    for (const InputNode& item : need(key).list) items.emplace_back(item);
    return items;
  }

 private:
  const InputNode& need(const char* key) const {
    const InputEntry* entry = node_.find(key);
    if (entry == nullptr)
      throw InputError({node_.where, key, "is missing", "this is no record of a validation",
                        "run all cases again, without --update"});
    return entry->value;
  }
  const InputNode& node_;
};

ValidationRung rung_of(const Reader& from) {
  ValidationRung rung;
  rung.setting = from.text("setting");
  rung.number = from.number("number");
  rung.error = from.number("error");
  rung.gate = from.maybe("gate");
  rung.stable = from.flag("stable");
  rung.message = from.text("message");
  rung.seconds = from.number("seconds");
  rung.particle_steps = from.number("particle_steps");
  rung.command = from.text("command");
  for (const Reader& value : from.list("values"))
    rung.values.push_back({value.text("what"), value.number("measured"), value.number("reference")});
  return rung;
}

MadeBy made_by(const Reader& program, const Reader& machine) {
  return {program.text("version"), program.text("commit"), program.text("compiler"),
          program.text("flags"),   machine.text("cpu"),    static_cast<int>(machine.number("threads"))};
}

ValidationCase case_of(const Reader& from, const Reader& record) {
  ValidationCase c;
  c.name = from.text("name");
  c.title = from.text("title");
  c.group = from.text("group");
  c.norm = from.text("norm");
  c.vary = from.text("vary");
  c.source = from.text("source");
  c.particle = from.text("particle");
  c.shortfall = from.text("shortfall");
  c.order = from.maybe("order");
  c.least_order = from.maybe("least_order");
  for (const Reader& rung : from.list("rungs")) c.rungs.push_back(rung_of(rung));
  // Keys that came later.
  if (from.has("why")) c.why = from.text("why");
  c.rungs_in_ladder = from.has("rungs_in_ladder") ? static_cast<std::size_t>(from.number("rungs_in_ladder"))
                                                  : c.rungs.size() + (from.flag("whole_ladder") ? 0 : 1);
  c.made_by = from.has("made_by") ? made_by(from.at("made_by"), from.at("made_by"))
                                  : made_by(record.at("sluice"), record.at("machine"));
  return c;
}

}  // namespace

std::vector<ValidationCase> kept_cases(const std::filesystem::path& file,
                                       const std::vector<std::filesystem::path>& folders) {
  if (!std::filesystem::exists(file)) return {};
  std::vector<InputProblem> problems;
  const InputNode tree = parse_yaml(read_bytes(file), file.string(), file.parent_path().string(), problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  const Reader record(tree);
  std::vector<ValidationCase> cases;
  for (const Reader& one : record.list("cases")) {
    ValidationCase c = case_of(one, record);
    if (std::any_of(folders.begin(), folders.end(), [&](const auto& f) { return f.filename() == c.name; }))
      cases.push_back(std::move(c));
  }
  std::sort(cases.begin(), cases.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return cases;
}

}  // namespace sluice
