#include "output/run_manifest.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/errors.h"
#include "output/run_folder.h"

namespace sluice {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::pair<Outcome, const char*>, 4> outcome_words = {
    {{Outcome::running, "running"},
     {Outcome::completed, "completed"},
     {Outcome::interrupted, "interrupted"},
     {Outcome::failed, "failed"}}};

// Every structure declares its keys once, in fields(); Writer and Reader both visit that.
class Writer;
class Reader;

template <class V>
void fields(V& v, BudgetEntry& b) {
  v("initial_kg", b.initial_kg);
  v("requested_kg", b.requested_kg);
  v("entered_kg", b.entered_kg);
  v("waiting_kg", b.waiting_kg);
  v("inside_kg", b.inside_kg);
  v("left_kg", b.left_kg);
  v("lost_kg", b.lost_kg);
}
template <class V>
void fields(V& v, RunManifest::Program& p) {
  v("version", p.version);
  v("commit", p.commit);
  v("compiler", p.compiler);
  v("flags", p.flags);
}
template <class V>
void fields(V& v, RunManifest::Process& p) {
  v("file", p.file);
  v("sha256", p.sha256);
  v("title", p.title);
}
template <class V>
void fields(V& v, RunManifest::Machine& m) {
  v("threads", m.threads);
  v("cpu", m.cpu);
}
template <class V>
void fields(V& v, RunManifest::Failure& f) {
  v("stage", f.stage);
  v("time_s", f.time_s);
  v("message", f.message);
}
template <class V>
void fields(V& v, RunManifest::Clock& t) {
  v("simulated_s", t.simulated_s);
  v("planned_s", t.planned_s);
  v("wall_s", t.wall_s);
  v("steps", t.steps);
  v("dt_fluid_s", t.dt_fluid_s);
  v("dt_rock_s", t.dt_rock_s);
  v("rock_steps", t.rock_steps);
  v("fluid_steps", t.fluid_steps);
  v("rock_step_governed_by", t.rock_step_governed_by);
  v("fluid_step_governed_by", t.fluid_step_governed_by);
}
template <class V>
void fields(V& v, RunManifest::PartList& p) {
  v("present", p.present);
  v("left_out", p.left_out);
}
template <class V>
void fields(V& v, RunManifest::Counts& c) {
  v("rocks", c.rocks);
  v("rocks_max", c.rocks_max);
  v("water_points", c.water_points);
  v("water_points_max", c.water_points_max);
  v("wall_triangles", c.wall_triangles);
}
template <class V>
void fields(V& v, RunManifest::Resolved& r) {
  v("from_m", r.from_m);
  v("partly_from_m", r.partly_from_m);
  v("rocks_max", r.rocks_max);
  v("rocks_partly_max", r.rocks_partly_max);
}
template <class V>
void fields(V& v, RunManifest::Budgets& b) {
  v("rock", b.rock);
  v("water", b.water);
  v("fines", b.fines);
  v("momentum_residual_N_s", b.momentum_residual_N_s);
  v.null_if_empty("energy", b.energy);
}
template <class V>
void fields(V& v, RunManifest::Overlap& o) {
  v("mean_percent_of_radius", o.mean_percent_of_radius);
  v("p99_percent_of_radius", o.p99_percent_of_radius);
  v("max_percent_of_radius", o.max_percent_of_radius);
}
template <class V>
void fields(V& v, RunManifest::Memory& m) {
  v("peak_bytes", m.peak_bytes);
  v("fluid_bytes", m.fluid_bytes);
  v("rock_bytes", m.rock_bytes);
}
template <class V>
void fields(V& v, RunManifest::StageTime& s) {
  v("name", s.name);
  v("seconds", s.seconds);
  v("calls", s.calls);
}
template <class V>
void fields(V& v, RunManifest::Rates& r) {
  v("water_point_steps_per_s", r.water_point_steps_per_s);
  v("rock_steps_per_s", r.rock_steps_per_s);
}
template <class V>
void fields(V& v, RunManifest::Figure& f) {  // the name is the key in `figures`
  v("value", f.value);
  v("low95", f.low95);
  v("high95", f.high95);
}
template <class V>
void fields(V& v, RunManifest::ExitAverages& a) {
  v("from_s", a.from_s);
  v("to_s", a.to_s);
  v("steady", a.steady);
  v("reason", a.reason);
  v("figures", a.figures);
}
template <class V>
void fields(V& v, RunManifest::ExitSummary& e) {  // the name is the key in `exits`
  v("rock_kg_s", e.rock_kg_s);
  v("water_kg_s", e.water_kg_s);
  v("rock_cov_across_width", e.rock_cov_across_width);
  v("water_cov_across_width", e.water_cov_across_width);
  v("water_to_rock_cov", e.water_to_rock_cov);
  v("steady_from_s", e.steady_from_s);
  v("rock_cov_corrected", e.rock_cov_corrected);
  v("water_m3_per_t", e.water_m3_per_t);
  v("dry_rock_fraction", e.dry_rock_fraction);
  v("rock_size_p80_m", e.rock_size_p80_m);
  v("rock_kg", e.rock_kg);
  v("water_kg", e.water_kg);
  v("averages", e.averages);
}
template <class V>
void fields(V& v, RunManifest& m) {
  v("sluice", m.sluice);
  v("process", m.process);
  v("machine", m.machine);
  v("outcome", m.outcome);
  v("failure", m.failure);
  v("time", m.time);
  v("parts", m.parts);
  v("counts", m.counts);
  v("resolved", m.resolved);
  v("budgets", m.budgets);
  // promised keys are there whatever the scene, so an absent overlap is an object of nulls
  v.nulls_if_absent("overlap", m.overlap);
  v("memory", m.memory);
  v("stages", m.stages);
  v("rates", m.rates);
  v("exits", m.exits);
  v("state_hash", m.state_hash);
  v("warnings", m.warnings);
}

class Writer {
 public:
  Json json = Json::object();

  template <class T>
  void operator()(const char* key, T& value) {
    json[key] = convert(value);
  }
  void null_if_empty(const char* key, NamedNumbers& value) {
    json[key] = value.empty() ? Json(nullptr) : convert(value);
  }
  template <class T>
  void nulls_if_absent(const char* key, std::optional<T>& value) {
    if (value) return (*this)(key, *value);
    T nothing;
    json[key] = convert(nothing);
    for (auto& item : json[key]) item = nullptr;
  }

 private:
  static Json convert(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }
  static Json convert(int x) { return x; }
  static Json convert(bool x) { return x; }
  static Json convert(std::int64_t x) { return x; }
  static Json convert(const std::string& x) { return x; }
  static Json convert(Outcome x) {
    for (const auto& [outcome, word] : outcome_words)
      if (outcome == x) return word;
    return nullptr;
  }
  static Json convert(const std::vector<std::string>& x) { return x; }
  static Json convert(const std::array<double, 3>& x) {
    return {convert(x[0]), convert(x[1]), convert(x[2])};
  }
  static Json convert(const NamedNumbers& x) {
    Json object = Json::object();
    for (const auto& [name, number] : x) object[name] = convert(number);
    return object;
  }
  static Json convert(std::vector<RunManifest::ExitSummary>& exits) {
    Json object = Json::object();
    for (auto& e : exits) object[e.name] = convert(e);
    return object;
  }
  static Json convert(std::vector<RunManifest::Figure>& figures) {
    Json object = Json::object();
    for (auto& f : figures) object[f.name] = convert(f);
    return object;
  }
  static Json convert(std::vector<RunManifest::StageTime>& stages) {
    Json list = Json::array();
    for (auto& s : stages) list.push_back(convert(s));
    return list;
  }
  template <class T>
  static Json convert(std::optional<T>& x) {
    return x ? convert(*x) : Json(nullptr);
  }
  template <class T>
  requires requires(Writer& w, T& t) { fields(w, t); }
  static Json convert(T& x) {
    Writer inner;
    fields(inner, x);
    return std::move(inner.json);
  }
};

class Reader {
 public:
  explicit Reader(const Json& json) : json_(json) {
    if (!json.is_object()) throw std::runtime_error("an object with keys was expected");
  }

  template <class T>
  void operator()(const char* key, T& value) {
    const auto found = json_.find(key);
    if (found != json_.end() && !found->is_null()) read(*found, value);
  }
  void null_if_empty(const char* key, NamedNumbers& value) { (*this)(key, value); }
  template <class T>
  void nulls_if_absent(const char* key, std::optional<T>& value) {
    const auto found = json_.find(key);
    if (found == json_.end() || !found->is_object()) return;
    for (const auto& item : *found)
      if (item.is_null()) return;
    read(*found, value);
  }

 private:
  static void read(const Json& j, double& x) { x = j.is_null() ? std::nan("") : j.get<double>(); }
  static void read(const Json& j, int& x) { x = j.get<int>(); }
  static void read(const Json& j, bool& x) { x = j.get<bool>(); }
  static void read(const Json& j, std::int64_t& x) { x = j.get<std::int64_t>(); }
  static void read(const Json& j, std::string& x) { x = j.get<std::string>(); }
  static void read(const Json& j, Outcome& x) {
    for (const auto& [outcome, word] : outcome_words)
      if (j == word) x = outcome;
  }
  static void read(const Json& j, std::vector<std::string>& x) { x = j.get<std::vector<std::string>>(); }
  static void read(const Json& j, std::array<double, 3>& x) {
    for (std::size_t k = 0; k < 3; ++k) read(j.at(k), x[k]);
  }
  static void read(const Json& j, NamedNumbers& x) {
    for (const auto& [name, number] : j.items()) read(number, x.emplace_back(name, 0.0).second);
  }
  static void read(const Json& j, std::vector<RunManifest::ExitSummary>& exits) {
    for (const auto& [name, exit] : j.items()) {
      exits.emplace_back().name = name;
      read(exit, exits.back());
    }
  }
  static void read(const Json& j, std::vector<RunManifest::Figure>& figures) {
    for (const auto& [name, figure] : j.items()) {
      constexpr double unknown = std::numeric_limits<double>::quiet_NaN();  // null in the file
      figures.push_back({name, unknown, unknown, unknown});
      read(figure, figures.back());
    }
  }
  static void read(const Json& j, std::vector<RunManifest::StageTime>& stages) {
    for (const auto& stage : j) read(stage, stages.emplace_back());
  }
  template <class T>
  static void read(const Json& j, std::optional<T>& x) {
    read(j, x.emplace());
  }
  template <class T>
  requires requires(Reader& r, T& t) { fields(r, t); }
  static void read(const Json& j, T& x) {
    Reader inner(j);
    fields(inner, x);
  }

  const Json& json_;
};

}  // namespace

double BudgetEntry::left_total() const {
  double sum = 0;
  for (const auto& [exit, kg] : left_kg) sum += kg;
  return sum;
}

double BudgetEntry::residual() const {
  return initial_kg + entered_kg - inside_kg - left_total();
}

std::string manifest_text(const RunManifest& manifest) {
  RunManifest copy = manifest;
  Writer writer;
  fields(writer, copy);
  // text that is not UTF-8 (a title, a path) is replaced, not fatal at the end of a long run
  return writer.json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_manifest(const std::filesystem::path& file, const RunManifest& manifest) {
  write_atomically(file, manifest_text(manifest));
}

RunManifest read_manifest(const std::filesystem::path& file) {
  const std::string text = read_whole_file(file);
  try {
    const Json json = Json::parse(text);
    if (!json.is_object() || !json.contains("outcome")) throw std::runtime_error("it has no 'outcome'");
    RunManifest manifest;
    Reader reader(json);
    fields(reader, manifest);
    return manifest;
  } catch (const std::exception& error) {
    refuse_file(file,
                {"is not the manifest of a run", error.what(), "name a folder that `sluice run` wrote"});
  }
}

}  // namespace sluice
