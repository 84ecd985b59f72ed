#include "analysis/exit_distribution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

/// What left through one bin (or all bins) in one part of the window.
struct Contents {
  BinSums sums;
  std::vector<double> size, mass;  ///< of the rocks
};

/// The window cut into batches of whole slots. Part 0 holds the slots before the first batch.
struct WindowParts {
  SlotRange slots;
  Batches batches;
  double interval = 0;  ///< [s]

  std::size_t count() const { return batches.count + 1; }
  std::size_t of_slot(std::size_t slot) const {
    const std::size_t k = slot - slots.first;
    return k < batches.first ? 0 : 1 + (k - batches.first) / batches.length;
  }
  /// [s] of the window but for one part.
  double seconds_without(std::size_t part) const {
    const std::size_t left_out = part == 0 ? 0 : batches.length;
    return static_cast<double>(slots.count() - left_out) * interval;
  }
};

/// Part 0 is always there: leaving it out stands for leaving nothing out.
constexpr std::size_t nothing = 0;

/// Contents[bin][part].
std::vector<std::vector<Contents>> contents_of(const ExitTally& tally, const WindowParts& parts) {
  std::vector<std::vector<Contents>> bins(tally.bin_count(), std::vector<Contents>(parts.count()));
  for (std::size_t slot = parts.slots.first; slot < parts.slots.last; ++slot)
    for (std::size_t bin = 0; bin < bins.size(); ++bin)
      add(bins[bin][parts.of_slot(slot)].sums, sums_at(tally, slot, bin));
  const RockRecord& rocks = tally.rocks();
  for (std::size_t i = 0; i < rocks.count(); ++i) {
    const auto slot = static_cast<std::size_t>(std::max(0.0, rocks.t[i] / parts.interval));
    if (slot < parts.slots.first || slot >= parts.slots.last) continue;
    Contents& c = bins[static_cast<std::size_t>(rocks.bin[i])][parts.of_slot(slot)];
    c.size.push_back(rocks.size[i]);
    c.mass.push_back(rocks.mass[i]);
  }
  return bins;
}

/// Bins [first, last) as one, without one part.
Contents joined(const std::vector<std::vector<Contents>>& bins, std::size_t first, std::size_t last,
                std::size_t left_out) {
  Contents all;
  for (std::size_t bin = first; bin < last; ++bin)
    for (std::size_t part = 0; part < bins[bin].size(); ++part) {
      if (part == left_out && left_out != nothing) continue;
      const Contents& c = bins[bin][part];
      add(all.sums, c.sums);
      all.size.insert(all.size.end(), c.size.begin(), c.size.end());
      all.mass.insert(all.mass.end(), c.mass.begin(), c.mass.end());
    }
  return all;
}

struct Figure {
  Estimate ExitFigures::*where;
  double (*of)(const Contents& c, double seconds, double water_density);
};

constexpr std::array<Figure, 14> all_figures = {{
    {&ExitFigures::rock_kg_s, [](const Contents& c, double t, double) { return ratio(c.sums.rock_kg, t); }},
    {&ExitFigures::water_kg_s, [](const Contents& c, double t, double) { return ratio(c.sums.water_kg, t); }},
    {&ExitFigures::fines_kg_s, [](const Contents& c, double t, double) { return ratio(c.sums.fines_kg, t); }},
    {&ExitFigures::dry_rock_kg_s,
     [](const Contents& c, double t, double) { return ratio(c.sums.dry_rock_kg, t); }},
    {&ExitFigures::rock_speed,
     [](const Contents& c, double, double) { return ratio(c.sums.rock_momentum, c.sums.rock_kg); }},
    {&ExitFigures::water_speed,
     [](const Contents& c, double, double) { return ratio(c.sums.water_momentum, c.sums.water_kg); }},
    {&ExitFigures::energy_per_rock,
     [](const Contents& c, double, double) { return ratio(c.sums.rock_energy, c.sums.rock_count); }},
    {&ExitFigures::rock_power,
     [](const Contents& c, double t, double) { return ratio(c.sums.rock_energy, t); }},
    {&ExitFigures::size_mean,
     [](const Contents& c, double, double) { return ratio(c.sums.rock_size_kg, c.sums.rock_kg); }},
    {&ExitFigures::p50,
     [](const Contents& c, double, double) { return weighted_quantile(c.size, c.mass, 0.5); }},
    {&ExitFigures::p80,
     [](const Contents& c, double, double) { return weighted_quantile(c.size, c.mass, 0.8); }},
    {&ExitFigures::residence,
     [](const Contents& c, double, double) { return ratio(c.sums.rock_residence_kg, c.sums.rock_kg); }},
    {&ExitFigures::m3_per_tonne,
     [](const Contents& c, double, double density) {
       return ratio((c.sums.water_kg - c.sums.fines_kg) / density, 1e-3 * c.sums.rock_kg);
     }},
    {&ExitFigures::dry_share,
     [](const Contents& c, double, double) { return ratio(c.sums.dry_rock_kg, c.sums.rock_kg); }},
}};

/// Masses of a whole exit per bin, without one part.
struct BinMasses {
  std::vector<double> rock, rock2, water, water2;
};

BinMasses masses_of(const std::vector<std::vector<Contents>>& bins, std::size_t left_out) {
  BinMasses m;
  for (const std::vector<Contents>& parts : bins) {
    BinSums sum;
    for (std::size_t part = 0; part < parts.size(); ++part)
      if (part != left_out || left_out == nothing) add(sum, parts[part].sums);
    m.rock.push_back(sum.rock_kg);
    m.rock2.push_back(sum.rock_kg2);
    m.water.push_back(sum.water_kg);
    m.water2.push_back(sum.water_kg2);
  }
  return m;
}

struct ThreeEvenness {
  Evenness rock, water, water_to_rock;
};

ThreeEvenness evenness_of(const BinMasses& m) {
  return {
      evenness(m.rock, m.rock2), evenness(m.water, m.water2),
      ratio_evenness({m.rock, m.water, effective_mass(m.rock, m.rock2), effective_mass(m.water, m.water2)})};
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

ExitDistribution exit_distribution(const ExitTally& tally, TimeWindow window, double water_density) {
  WindowParts parts;
  parts.slots = slots_in(tally, window);
  parts.batches = batches_of(parts.slots.count());
  parts.interval = tally.interval();
  const std::vector<std::vector<Contents>> bins = contents_of(tally, parts);

  const auto figures = [&](std::size_t first, std::size_t last) {
    std::vector<Contents> without;
    for (std::size_t part = 0; part < parts.count(); ++part)
      without.push_back(joined(bins, first, last, part));
    ExitFigures f;
    const double width = (tally.config().width_to - tally.config().width_from).norm();
    const double per_bin = width / static_cast<double>(tally.bin_count());
    f.from = static_cast<double>(first) * per_bin;
    f.to = static_cast<double>(last) * per_bin;
    f.rock_count = without[nothing].sums.rock_count;
    for (const Figure& figure : all_figures) {
      std::vector<double> values;
      for (std::size_t part = 0; part < parts.count(); ++part)
        values.push_back(figure.of(without[part], parts.seconds_without(part), water_density));
      f.*figure.where = {values[nothing], jackknife_half_width({values.begin() + 1, values.end()})};
    }
    return f;
  };

  ExitDistribution d;
  d.window = {static_cast<double>(parts.slots.first) * tally.interval(),
              static_cast<double>(parts.slots.last) * tally.interval()};
  for (std::size_t bin = 0; bin < tally.bin_count(); ++bin) d.bins.push_back(figures(bin, bin + 1));
  d.all = figures(0, tally.bin_count());

  const ThreeEvenness whole = evenness_of(masses_of(bins, nothing));
  std::vector<Evenness> rock, water, water_to_rock;
  for (std::size_t part = 1; part < parts.count(); ++part) {
    const ThreeEvenness without = evenness_of(masses_of(bins, part));
    rock.push_back(without.rock);
    water.push_back(without.water);
    water_to_rock.push_back(without.water_to_rock);
  }
  d.rock = whole.rock;
  d.water = whole.water;
  d.water_to_rock = whole.water_to_rock;
  set_limits(d.rock, rock);
  set_limits(d.water, water);
  set_limits(d.water_to_rock, water_to_rock);
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
