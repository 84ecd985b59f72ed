#include "app/exit_results.h"

#include "analysis/residence.h"
#include "analysis/steady_state.h"

namespace sluice {

namespace {

/// Mean time that rock which left by any exit spent inside [s]; 0 = none left yet.
double residence_time(const std::vector<ExitTally>& tallies, double now) {
  double kg_s = 0, kg = 0;
  for (const ExitTally& tally : tallies) {
    if (!(tally.rock_kg() > 0)) continue;
    kg_s += tally.rock_kg() * residence_times(tally, 0, now).mean;
    kg += tally.rock_kg();
  }
  return kg > 0 ? kg_s / kg : 0.0;
}

}  // namespace

std::vector<ExitResult> exit_results(const Simulation& simulation) {
  const Parts& parts = simulation.parts();
  const double now = simulation.time();
  const double density = parts.water ? parts.water->model().density : 1000.0;
  const double residence = residence_time(parts.exits->tallies(), now);
  std::vector<ExitResult> results;
  for (const ExitTally& tally : parts.exits->tallies()) {
    ExitResult result;
    result.name = tally.config().name;
    std::vector<SteadySignal> signals;
    if (tally.rock_kg() > 0) signals.push_back({"rock out", rock_series(tally, now)});
    if (tally.water_kg() > 0) signals.push_back({"water out", water_series(tally, now)});
    if (signals.empty()) {
      result.reason = "nothing has left";
    } else {
      const SteadyState steady = find_steady_state(signals, tally.interval(), residence);
      result.steady_from = steady.from;
      result.reason = steady.reason;
    }
    result.distribution = exit_distribution(tally, {result.steady_from.value_or(0.5 * now), now}, density);
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace sluice
