#include "analysis/exit_distribution.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/statistics.h"

namespace sluice {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

double ratio(double a, double b) {
  return b > 0 ? a / b : not_known;
}

/// Whole slots inside a window: [first, last).
struct SlotRange {
  std::size_t first = 0, last = 0;
  std::size_t count() const { return last - first; }
};

SlotRange slots_in(const ExitTally& tally, TimeWindow w) {
  // Times are multiples of the interval up to rounding.
  const double slack = 1e-6;
  const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(w.from / tally.interval() - slack)));
  const auto last = static_cast<std::size_t>(std::max(0.0, std::floor(w.to / tally.interval() + slack)));
  return {first, std::max(first, last)};
}

/// Sums of the slots; those after the last passage are empty.
BinSums sums_at(const ExitTally& tally, std::size_t slot, std::size_t bin) {
  return slot < tally.slots() ? tally.at(slot, bin) : BinSums{};
}

void add(BinSums& a, const BinSums& b) {
  a.rock_kg += b.rock_kg;
  a.rock_kg2 += b.rock_kg2;
  a.rock_count += b.rock_count;
  a.water_kg += b.water_kg;
  a.water_kg2 += b.water_kg2;
  a.fines_kg += b.fines_kg;
  a.rock_momentum += b.rock_momentum;
  a.water_momentum += b.water_momentum;
  a.rock_size_kg += b.rock_size_kg;
  a.rock_energy += b.rock_energy;
  a.rock_residence_kg += b.rock_residence_kg;
  a.dry_rock_kg += b.dry_rock_kg;
}

/// Rocks of one bin (or of all, bin = -1) that left in a window.
struct SizeSample {
  std::vector<double> size, mass;
};

SizeSample sizes_in(const RockRecord& rocks, TimeWindow w, int bin) {
  SizeSample sample;
  for (std::size_t i = 0; i < rocks.count(); ++i) {
    if (rocks.t[i] < w.from || rocks.t[i] >= w.to || (bin >= 0 && rocks.bin[i] != bin)) continue;
    sample.size.push_back(rocks.size[i]);
    sample.mass.push_back(rocks.mass[i]);
  }
  return sample;
}

/// Figures of bins [first, last) as one.
ExitFigures figures(const ExitTally& tally, SlotRange slots, std::size_t first, std::size_t last,
                    double water_density) {
  BinSums sum;
  std::vector<double> rock, water;
  for (std::size_t slot = slots.first; slot < slots.last; ++slot) {
    BinSums in_slot;
    for (std::size_t bin = first; bin < last; ++bin) add(in_slot, sums_at(tally, slot, bin));
    rock.push_back(in_slot.rock_kg / tally.interval());
    water.push_back(in_slot.water_kg / tally.interval());
    add(sum, in_slot);
  }
  const double width = (tally.config().width_to - tally.config().width_from).norm();
  const double per_bin = width / static_cast<double>(tally.bin_count());
  const double seconds = static_cast<double>(slots.count()) * tally.interval();
  const TimeWindow window{static_cast<double>(slots.first) * tally.interval(),
                          static_cast<double>(slots.last) * tally.interval()};
  const SizeSample sizes = sizes_in(tally.rocks(), window, last - first == 1 ? static_cast<int>(first) : -1);

  ExitFigures f;
  f.from = static_cast<double>(first) * per_bin;
  f.to = static_cast<double>(last) * per_bin;
  f.rock_kg_s = batch_mean(rock);
  f.water_kg_s = batch_mean(water);
  f.fines_kg_s = ratio(sum.fines_kg, seconds);
  f.rock_count = sum.rock_count;
  f.rock_speed = ratio(sum.rock_momentum, sum.rock_kg);
  f.water_speed = ratio(sum.water_momentum, sum.water_kg);
  f.energy_per_rock = ratio(sum.rock_energy, sum.rock_count);
  f.size_mean = ratio(sum.rock_size_kg, sum.rock_kg);
  f.p50 = weighted_quantile(sizes.size, sizes.mass, 0.5);
  f.p80 = weighted_quantile(sizes.size, sizes.mass, 0.8);
  f.residence = ratio(sum.rock_residence_kg, sum.rock_kg);
  f.m3_per_tonne = ratio((sum.water_kg - sum.fines_kg) / water_density, 1e-3 * sum.rock_kg);
  f.dry_share = ratio(sum.dry_rock_kg, sum.rock_kg);
  return f;
}

/// corrected^2 = raw^2 - floor^2, at least 0.
Evenness corrected(double raw2, double floor2) {
  return {std::sqrt(raw2), std::sqrt(floor2), std::sqrt(std::max(0.0, raw2 - floor2))};
}

/// Mass of a typical particle as the mass sees it: sum m^2 / sum m.
double effective_mass(const std::vector<double>& masses, const std::vector<double>& squares) {
  double m = 0, m2 = 0;
  for (double x : masses) m += x;
  for (double x : squares) m2 += x;
  return m > 0 ? m2 / m : 0;
}

Evenness ratio_evenness(const std::vector<double>& rock, const std::vector<double>& water, double rock_grain,
                        double water_grain) {
  double all_rock = 0, all_water = 0;
  std::size_t filled = 0;
  for (std::size_t b = 0; b < rock.size(); ++b) {
    if (rock[b] <= 0) continue;
    all_rock += rock[b];
    all_water += water[b];
    ++filled;
  }
  if (filled < 2 || all_water <= 0) return {not_known, not_known, not_known};
  const double overall = all_water / all_rock;
  double square = 0;
  for (std::size_t b = 0; b < rock.size(); ++b)
    if (rock[b] > 0) square += rock[b] * std::pow(water[b] / rock[b] / overall - 1, 2);
  const auto n = static_cast<double>(filled);
  return corrected(square / all_rock * n / (n - 1), n * (rock_grain + water_grain / overall) / all_rock);
}

template <class Pick>
std::vector<double> series(const ExitTally& tally, double until, Pick pick) {
  std::vector<double> sums;
  for (std::size_t slot = 0; slot < slots_in(tally, {0, until}).last; ++slot) {
    double sum = 0;
    for (std::size_t bin = 0; bin < tally.bin_count(); ++bin) sum += pick(sums_at(tally, slot, bin));
    sums.push_back(sum);
  }
  return sums;
}

}  // namespace

Evenness evenness(const std::vector<double>& masses, const std::vector<double>& squares) {
  const double per_bin = mean(masses);
  if (masses.size() < 2 || per_bin <= 0) return {not_known, not_known, not_known};
  return corrected(variance(masses) / (per_bin * per_bin), effective_mass(masses, squares) / per_bin);
}

ExitDistribution exit_distribution(const ExitTally& tally, TimeWindow window, double water_density) {
  const SlotRange slots = slots_in(tally, window);
  ExitDistribution d;
  d.window = {static_cast<double>(slots.first) * tally.interval(),
              static_cast<double>(slots.last) * tally.interval()};
  std::vector<double> rock, rock2, water, water2;
  for (std::size_t bin = 0; bin < tally.bin_count(); ++bin) {
    d.bins.push_back(figures(tally, slots, bin, bin + 1, water_density));
    BinSums sum;
    for (std::size_t slot = slots.first; slot < slots.last; ++slot) add(sum, sums_at(tally, slot, bin));
    rock.push_back(sum.rock_kg);
    rock2.push_back(sum.rock_kg2);
    water.push_back(sum.water_kg);
    water2.push_back(sum.water_kg2);
  }
  d.all = figures(tally, slots, 0, tally.bin_count(), water_density);
  d.rock = evenness(rock, rock2);
  d.water = evenness(water, water2);
  d.water_to_rock = ratio_evenness(rock, water, effective_mass(rock, rock2), effective_mass(water, water2));
  return d;
}

std::vector<double> rock_series(const ExitTally& tally, double until) {
  return series(tally, until, [](const BinSums& b) { return b.rock_kg; });
}

std::vector<double> water_series(const ExitTally& tally, double until) {
  return series(tally, until, [](const BinSums& b) { return b.water_kg; });
}

double reached_fraction(const std::vector<ExitTally>& tallies, double feed_kg_s, TimeWindow window) {
  double rate = 0;
  for (const ExitTally& tally : tallies) {
    const SlotRange slots = slots_in(tally, window);
    if (slots.count() == 0) return 0;
    double sum = 0;
    for (std::size_t slot = slots.first; slot < slots.last; ++slot)
      for (std::size_t bin = 0; bin < tally.bin_count(); ++bin) sum += sums_at(tally, slot, bin).rock_kg;
    rate += sum / (static_cast<double>(slots.count()) * tally.interval());
  }
  return feed_kg_s > 0 ? rate / feed_kg_s : 0;
}

}  // namespace sluice
