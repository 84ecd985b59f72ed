#include "dem/cell_grid.h"

#include <algorithm>

#include "base/parallel.h"

namespace sluice {

namespace {
constexpr int most_levels = 12;  // a size range of 4000:1
}

std::array<int, 3> CellGrid::cell_of(const Level& level, const Vec3& x) const {
  std::array<int, 3> cell;
  for (int k = 0; k < 3; ++k) {
    const double place = std::floor((x[k] - origin_[k]) / level.width[k]);
    cell[static_cast<std::size_t>(k)] = static_cast<int>(std::clamp(place, -1e9, 1e9));
  }
  return cell;
}

int CellGrid::runs(int first, int last, int wrap, Run (&out)[2]) {
  if (wrap == 0) {
    out[0] = {first, last};
    return 1;
  }
  if (last - first + 1 >= wrap) {
    out[0] = {0, wrap - 1};
    return 1;
  }
  const int shift = wrap * static_cast<int>(std::floor(static_cast<double>(first) / wrap));
  first -= shift;
  last -= shift;
  if (last < wrap) {
    out[0] = {first, last};
    return 1;
  }
  out[0] = {0, last - wrap};
  out[1] = {first, wrap - 1};
  return 2;
}

void CellGrid::build(std::span<const Vec3> x, std::span<const double> reach, const Domain& domain) {
  const std::size_t n = x.size();
  origin_ = domain.box.empty() ? Vec3(Vec3::Zero()) : domain.box.lo;
  for (int k = 0; k < 3; ++k)
    if (!std::isfinite(origin_[k])) origin_[k] = 0;
  double widest = 0;
  for (double r : reach) widest = std::max(widest, r);

  level_.resize(n);
  levels_.assign(most_levels, {});
  parallel_for(n, [&](std::size_t i) {
    level_[i] = std::clamp(static_cast<int>(std::floor(std::log2(widest / reach[i]))), 0, most_levels - 1);
  });
  for (std::size_t i = 0; i < n; ++i) levels_[static_cast<std::size_t>(level_[i])].used = true;
  while (!levels_.empty() && !levels_.back().used) levels_.pop_back();
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& level = levels_[l];
    level.half = std::ldexp(widest, -static_cast<int>(l));
    for (int k = 0; k < 3; ++k) {
      level.width[k] = 2 * level.half;
      level.wrap[static_cast<std::size_t>(k)] = 0;
      if (!domain.periodic(k)) continue;
      const double length = domain.box.hi[k] - domain.box.lo[k];
      const int cells = std::max(1, static_cast<int>(std::floor(length / level.width[k])));
      level.wrap[static_cast<std::size_t>(k)] = cells;
      level.width[k] = length / cells;
    }
  }

  std::size_t buckets = 64;
  while (buckets < 2 * n) buckets *= 2;
  mask_ = buckets - 1;
  binned_.resize(n);
  parallel_for(n, [&](std::size_t i) {
    const Level& level = levels_[static_cast<std::size_t>(level_[i])];
    Entry& entry = binned_[i];
    entry.item = static_cast<int>(i);
    entry.level = level_[i];
    entry.cell = cell_of(level, x[i]);
    for (std::size_t k = 0; k < 3; ++k)
      if (const int wrap = level.wrap[k]; wrap > 0) entry.cell[k] = ((entry.cell[k] % wrap) + wrap) % wrap;
  });
  const auto bucket = [&](const Entry& e) {
    return (row(e.level, e.cell[1], e.cell[2]) + static_cast<std::size_t>(e.cell[0])) & mask_;
  };
  start_.assign(buckets + 1, 0);
  for (const Entry& e : binned_) ++start_[bucket(e) + 1];
  for (std::size_t b = 0; b < buckets; ++b) start_[b + 1] += start_[b];
  entries_.resize(n);
  for (auto e = binned_.rbegin(); e != binned_.rend(); ++e) entries_[--start_[bucket(*e) + 1]] = *e;
  // Filling from behind left start_[b + 1] at the first entry of bucket b.
  for (std::size_t b = 0; b < buckets; ++b) start_[b] = start_[b + 1];
  start_[buckets] = static_cast<std::uint32_t>(n);
}

std::size_t CellGrid::memory_bytes() const {
  return level_.capacity() * sizeof(int) + (binned_.capacity() + entries_.capacity()) * sizeof(Entry) +
         start_.capacity() * sizeof(std::uint32_t);
}

}  // namespace sluice
