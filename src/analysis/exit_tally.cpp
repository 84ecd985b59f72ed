#include <algorithm>
#include <cmath>

#include "analysis/exits.h"

namespace sluice {

namespace {

/// Ends of the longest level edge of a box.
void set_width(ExitConfig& c, const Box& box) {
  if (c.width_from != c.width_to || box.empty()) return;
  const int axis = box.size().x() >= box.size().y() ? 0 : 1;
  c.width_from = c.width_to = box.centre();
  c.width_from[axis] = box.lo[axis];
  c.width_to[axis] = box.hi[axis];
}

}  // namespace

ExitTally::ExitTally(ExitConfig config, double interval) : config_(std::move(config)), interval_(interval) {
  if (config_.kind != ExitKind::deck) set_width(config_, {config_.low, config_.high});
}

std::size_t ExitTally::bin_of(const Vec3& x) const {
  const Vec3 width = config_.width_to - config_.width_from;
  const double length2 = width.squaredNorm();
  if (length2 == 0) return 0;
  const double place = (x - config_.width_from).dot(width) / length2 * static_cast<double>(bin_count());
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(bin_count() - 1)));
}

void ExitTally::add(const Passage& p) {
  const auto slot = static_cast<std::size_t>(std::max(0.0, p.t) / interval_);
  if (slot >= slots()) bins_per_slot_.resize((slot + 1) * bin_count());
  const std::size_t bin = bin_of(p.x);
  BinSums& sums = bins_per_slot_[slot * bin_count() + bin];
  const double speed = p.v.norm();
  if (!p.rock) {
    sums.water_kg += p.mass;
    sums.water_kg2 += p.mass * p.mass;
    sums.fines_kg += p.fines_mass;
    sums.water_momentum += p.mass * speed;
    water_kg_ += p.mass;
    fines_kg_ += p.fines_mass;
    water_momentum_ += p.mass * p.v;
    return;
  }
  sums.rock_kg += p.mass;
  sums.rock_kg2 += p.mass * p.mass;
  sums.rock_count += 1;
  sums.rock_momentum += p.mass * speed;
  sums.rock_size_kg += p.mass * p.size;
  sums.rock_energy += 0.5 * p.mass * speed * speed;
  sums.rock_residence_kg += p.mass * (p.t - p.birth);
  if (p.wet_dose <= config_.dry_dose) sums.dry_rock_kg += p.mass;
  rock_kg_ += p.mass;
  rock_momentum_ += p.mass * p.v;
  rocks_.t.push_back(p.t);
  rocks_.size.push_back(p.size);
  rocks_.mass.push_back(p.mass);
  rocks_.residence.push_back(p.t - p.birth);
  rocks_.wet_dose.push_back(p.wet_dose);
  rocks_.bin.push_back(static_cast<std::int32_t>(bin));
}

void ExitTally::exchange(StateArchive& archive) {
  static_assert(sizeof(BinSums) == 12 * sizeof(double));  // a new sum must be stored too
  std::vector<std::array<double, 12>> rows;
  for (const BinSums& b : bins_per_slot_)
    rows.push_back({b.rock_kg, b.rock_kg2, b.rock_count, b.water_kg, b.water_kg2, b.fines_kg, b.rock_momentum,
                    b.water_momentum, b.rock_size_kg, b.rock_energy, b.rock_residence_kg, b.dry_rock_kg});
  archive.values("bins_per_slot", rows);
  bins_per_slot_.clear();
  for (const auto& r : rows)
    bins_per_slot_.push_back({r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8], r[9], r[10], r[11]});
  archive.values("rock_t", rocks_.t);
  archive.values("rock_size", rocks_.size);
  archive.values("rock_mass", rocks_.mass);
  archive.values("rock_residence", rocks_.residence);
  archive.values("rock_wet_dose", rocks_.wet_dose);
  archive.values("rock_bin", rocks_.bin);
  archive.value("rock_kg", rock_kg_);
  archive.value("water_kg", water_kg_);
  archive.value("fines_kg", fines_kg_);
  archive.value("rock_momentum", rock_momentum_);
  archive.value("water_momentum", water_momentum_);
}

}  // namespace sluice
