#include "analysis/mixing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sluice {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
/// Least s0^2 over sR^2 for a Lacey index: the share's variance then falls by half at least from apart to
/// random, and the index of a random mixture scatters by less than its range.
constexpr double least_contrast = 2;
constexpr std::int64_t most_cells = 10'000'000;  // of one zone: 160 MB

/// Cells of a box, slab by slab.
struct CellGrid {
  Box box;
  std::array<std::int64_t, 3> counts{1, 1, 1};  ///< axis 0: the slabs' own
  std::array<int, 3> axes{2, 0, 1};             ///< the slabs' axis first
  std::int64_t slabs = 1;

  CellGrid(const MixingConfig& c)
      : box{c.low, c.high}, axes{c.axis, (c.axis + 1) % 3, (c.axis + 2) % 3}, slabs(c.slabs) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = box.size()[axes[k]] / (k == 0 ? static_cast<double>(slabs) : 1.0);
      counts[k] = std::max<std::int64_t>(1, std::llround(length / c.cell));
    }
    counts[0] *= slabs;
  }
  std::size_t count() const { return static_cast<std::size_t>(counts[0] * counts[1] * counts[2]); }
  std::size_t per_slab() const { return count() / static_cast<std::size_t>(slabs); }
  /// Cell of a point, or count() for one outside.
  std::size_t cell_of(const Vec3& x) const {
    if (!box.contains(x)) return count();
    std::int64_t cell = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int axis = axes[k];
      const double place = (x[axis] - box.lo[axis]) / box.size()[axis] * static_cast<double>(counts[k]);
      cell = cell * counts[k] + std::min(counts[k] - 1, static_cast<std::int64_t>(place));
    }
    return static_cast<std::size_t>(cell);
  }
};

/// What a slab holds beside its cells.
struct SlabSums {
  double rock_kg = 0, water_kg = 0, wetted_kg = 0, met_kg = 0;
};

/// Effective grain: sum v^2 / sum v.
struct Grain {
  double v = 0, v2 = 0;
  void add(double volume) {
    v += volume;
    v2 += volume * volume;
  }
  double size() const { return v > 0 ? v2 / v : 0; }
};

}  // namespace

MixIndices mix_indices(const std::vector<MixCell>& cells, double grain_a, double grain_b) {
  MixIndices m{not_known, not_known, not_known, not_known, not_known};
  double a = 0, all = 0, filled = 0;
  for (const MixCell& c : cells) {
    a += c.a;
    all += c.a + c.b;
    filled += c.a + c.b > 0 ? 1 : 0;
  }
  if (all <= 0) return m;
  m.share = a / all;
  if (filled < 2) return m;
  double square = 0;
  for (const MixCell& c : cells) {
    const double content = c.a + c.b;
    if (content > 0) square += content * std::pow(c.a / content - m.share, 2);
  }
  m.variance = square / all * filled / (filled - 1);
  const double p = m.share, q = 1 - p;
  if (p <= 0 || q <= 0) return m;
  const double apart = p * q;
  const double random = p * q * (p * grain_b + q * grain_a) * filled / all;
  m.rsd = std::sqrt(m.variance) / p;
  m.segregation = m.variance / apart;
  if (apart > least_contrast * random) m.lacey = (apart - m.variance) / (apart - random);
  return m;
}

void MixingConfig::keys(Schema& s) {
  where = s.here();
  s.vector("low", low,
           {.unit = "m", .required = true, .doc = "corner of the box with the smallest coordinates"});
  s.vector("high", high, {.unit = "m", .required = true, .doc = "corner with the largest coordinates"});
  s.choice("axis", axis, {{"x", 0}, {"y", 1}, {"z", 2}}, {.doc = "along which the box is cut into slabs"});
  s.integer("slabs", slabs, {.at_least = 1, .at_most = 1000, .doc = "parts along the axis"});
  s.number("cell", cell,
           {.unit = "m",
            .required = true,
            .above = 0,
            .doc = "edge of the cells whose contents are compared; about two top sizes"});
  s.number("interval", interval, {.unit = "s", .above = 0, .doc = "simulated time between looks"});
  if (s.given("low") && s.given("high") && !(low.array() < high.array()).all())
    s.problem("high", "is not above 'low' in every direction", "the box would have no volume",
              "swap or correct the corners");
  else if (s.given("low") && s.given("high") && cell > 0 &&
           ((high - low) / cell).cwiseMax(1).prod() > static_cast<double>(most_cells))
    s.problem("cell", fmt::format("is {:.3g} m", cell),
              fmt::format("the zone would have more than {} million cells", most_cells / 1'000'000),
              "use about two top sizes");
}

MixingProbe::MixingProbe(MixingConfig config)
    : config_(std::move(config)), whole_{not_known, not_known, not_known, not_known, not_known} {}

void MixingProbe::look(const SceneView& scene) {
  const CellGrid grid(config_);
  const auto slabs = static_cast<std::size_t>(config_.slabs);
  std::vector<MixCell> cells(grid.count());
  std::vector<SlabSums> sums(slabs);
  Grain water_grain, rock_grain;

  if (scene.water != nullptr) {
    const WaterPoints points = scene.water->points();
    const double volume = scene.water->point_volume();
    for (std::size_t i = 0; i < points.count(); ++i) {
      const std::size_t cell = grid.cell_of(points.x[i]);
      if (cell == grid.count()) continue;
      cells[cell].a += volume * points.J[i];
      water_grain.add(volume * points.J[i]);
      sums[cell / grid.per_slab()].water_kg += points.mass[i];
    }
  }
  if (scene.rocks != nullptr) {
    const Rocks& rocks = scene.rocks->rocks();
    for (std::size_t i = 0; i < rocks.count(); ++i) {
      const std::size_t cell = grid.cell_of(rocks.x[i]);
      if (cell == grid.count()) continue;
      const double volume = scene.rocks->volume(i);
      cells[cell].b += volume;
      rock_grain.add(volume);
      SlabSums& slab = sums[cell / grid.per_slab()];
      slab.rock_kg += rocks.mass[i];
      slab.wetted_kg += rocks.mass[i] * rocks.wetted[i];
      if (rocks.wet_dose[i] > 0) slab.met_kg += rocks.mass[i];
    }
  }

  whole_ = mix_indices(cells, water_grain.size(), rock_grain.size());
  const double thickness = grid.box.size()[config_.axis] / static_cast<double>(slabs);
  for (std::size_t k = 0; k < slabs; ++k) {
    const auto first = cells.begin() + static_cast<std::ptrdiff_t>(k * grid.per_slab());
    const MixIndices m = mix_indices({first, first + static_cast<std::ptrdiff_t>(grid.per_slab())},
                                     water_grain.size(), rock_grain.size());
    rows_.push_back({.t = scene.t,
                     .position = grid.box.lo[config_.axis] + (static_cast<double>(k) + 0.5) * thickness,
                     .rock_kg = sums[k].rock_kg,
                     .water_kg = sums[k].water_kg,
                     .lacey = m.lacey,
                     .rsd = m.rsd,
                     .segregation = m.segregation,
                     .wetted = sums[k].rock_kg > 0 ? sums[k].wetted_kg / sums[k].rock_kg : not_known,
                     .met_water = sums[k].rock_kg > 0 ? sums[k].met_kg / sums[k].rock_kg : not_known});
  }
}

std::vector<std::string> MixingProbe::columns() const {
  return {config_.name + "_lacey", config_.name + "_rsd", config_.name + "_segregation"};
}

std::vector<double> MixingProbe::values() const {
  return {whole_.lacey, whole_.rsd, whole_.segregation};
}

void MixingProbe::exchange(StateArchive& archive) {
  std::vector<std::array<double, 9>> rows;
  for (const MixingRow& r : rows_)
    rows.push_back(
        {r.t, r.position, r.rock_kg, r.water_kg, r.lacey, r.rsd, r.segregation, r.wetted, r.met_water});
  archive.values("rows", rows);
  rows_.clear();
  for (const auto& r : rows) rows_.push_back({r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]});
  archive.value("share", whole_.share);
  archive.value("variance", whole_.variance);
  archive.value("lacey", whole_.lacey);
  archive.value("rsd", whole_.rsd);
  archive.value("segregation", whole_.segregation);
}

}  // namespace sluice
