#include "validation/ladder.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "base/errors.h"
#include "output/csv.h"

namespace sluice {

namespace {

ValidationRung run_rung(const Case& what, const Rung& rung, const LadderOptions& options) {
  ValidationRung out;
  out.setting = rung.at;
  out.number = rung.number;
  out.gate = rung.gate;
  out.command = fmt::format("sluice validate {} --rung '{}'", what.name, rung.at);
  std::vector<std::string> keys{what.config.ladder.vary + "=" + rung.at};
  for (const std::string& key : options.scene_keys) {
    keys.push_back(key);
    out.command += fmt::format(" --set '{}'", key);
  }
  const CaseConfig config = read_case_with(what.file, keys);
  const CsvTable reference = read_csv(config.reference.table);
  out.error = std::numeric_limits<double>::quiet_NaN();
  const auto start = std::chrono::steady_clock::now();
  try {
    const Measured measured = config.scene->run(reference);
    out.particle_steps = measured.particle_steps;
    out.error = error_of(measured.values, config.norm);
    for (const Compared& v : measured.values) out.values.push_back({v.what, v.measured, v.reference});
    out.stable = std::isfinite(out.error);
    out.message = out.stable ? measured.note : "a measured value is not finite";
  } catch (const NumericalError& e) {
    out.stable = false;
    out.message = e.what();
  }
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

std::vector<Rung> rungs_to_run(const Case& what, const LadderOptions& options) {
  const LadderConfig& ladder = what.config.ladder;
  if (!options.only.empty()) {
    for (const Rung& rung : ladder.rungs)
      if (rung.at == options.only) return {rung};
    std::vector<std::string> all;
    for (const Rung& rung : ladder.rungs) all.push_back(rung.at);
    throw InputError({{"--rung", 0, 0},
                      "rung",
                      fmt::format("'{}' is not a rung of {}", options.only, what.name),
                      "",
                      fmt::format("there are {}", fmt::join(all, ", "))});
  }
  if (options.extent == LadderExtent::whole) return ladder.rungs;
  const auto count = std::min(ladder.rungs.size(), static_cast<std::size_t>(ladder.quick));
  return {ladder.rungs.begin(), ladder.rungs.begin() + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

std::optional<double> observed_order(const std::vector<double>& settings, const std::vector<double>& errors) {
  double n = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    if (!(errors[k] > 0) || !std::isfinite(errors[k]) || !(settings[k] > 0)) continue;
    const double x = std::log(settings[k]), y = std::log(errors[k]);
    n += 1;
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }
  const double spread = n * sum_xx - sum_x * sum_x;
  if (n < 2 || !(spread > 0)) return std::nullopt;
  const double slope = (n * sum_xy - sum_x * sum_y) / spread;
  return settings.back() > settings.front() ? -slope : slope;
}

ValidationCase run_ladder(const Case& what, const LadderOptions& options) {
  const CaseConfig& config = what.config;
  ValidationCase out;
  out.name = what.name;
  out.title = config.title;
  out.group = config.group;
  out.norm = norm_words(config.norm);
  out.vary = config.ladder.vary;
  out.source = config.reference.source;
  out.why = config.why;
  out.shortfall = config.shortfall;
  out.particle = find_measure(config.measure)->particle;
  out.least_order = config.ladder.least_order;
  out.rungs_in_ladder = config.ladder.rungs.size();
  std::vector<double> settings, errors;
  for (const Rung& rung : rungs_to_run(what, options)) {
    out.rungs.push_back(run_rung(what, rung, options));
    settings.push_back(out.rungs.back().number);
    errors.push_back(out.rungs.back().error);
    if (options.told) options.told(out, out.rungs.back());
  }
  if (!settings.empty()) out.order = observed_order(settings, errors);
  return out;
}

}  // namespace sluice
