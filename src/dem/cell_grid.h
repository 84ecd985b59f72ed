#pragma once
/// Finds what lies near a point, for items of very different sizes.
///
/// Items are binned by size into levels, each with cells half as wide as those of the level above; an
/// item sits in one cell of the finest level whose cells are as wide as it is. Cells are hashed, so
/// that memory follows the number of items; the cells of one row along x are neighbours in the table,
/// so that a row is one scan.

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/domain.h"

namespace sluice {

class CellGrid {
 public:
  /// @param reach  half the width that an item takes up (radius plus margin) [m], > 0
  void build(std::span<const Vec3> x, std::span<const double> reach, const Domain& domain);

  std::size_t count() const { return level_.size(); }
  int level(std::size_t item) const { return level_[item]; }
  std::size_t memory_bytes() const;

  /// Calls visit(item) once for each item of levels 0..`deepest` that may lie within its reach plus
  /// `reach` of x, and for some farther ones. The order depends on the items only.
  template <class Visit>
  void near(const Vec3& x, double reach, int deepest, const Visit& visit) const;
  int deepest() const { return static_cast<int>(levels_.size()) - 1; }

 private:
  struct Level {
    Vec3 width;               ///< of a cell [m]
    double half = 0;          ///< largest reach of an item here [m]
    std::array<int, 3> wrap;  ///< cells along a periodic axis, 0 = not periodic
    bool used = false;
  };
  struct Entry {
    int item, level;
    std::array<int, 3> cell;
  };
  struct Run {
    int first, last;
  };

  std::array<int, 3> cell_of(const Level& level, const Vec3& x) const;
  std::size_t row(int level, int cy, int cz) const {
    const std::uint64_t h =
        static_cast<std::uint64_t>(static_cast<std::uint32_t>(cy)) * 0x9e3779b97f4a7c15ULL ^
        static_cast<std::uint64_t>(static_cast<std::uint32_t>(cz)) * 0xc2b2ae3d27d4eb4fULL ^
        static_cast<std::uint64_t>(level) * 0x165667b19e3779f9ULL;
    return static_cast<std::size_t>(h >> 29);
  }
  /// Cells first..last as runs inside the periodic range; returns how many runs (1 or 2).
  static int runs(int first, int last, int wrap, Run (&out)[2]);
  template <class Visit>
  void scan(int level, Run x, int cy, int cz, const Visit& visit) const;

  std::vector<Level> levels_;
  std::vector<int> level_;     ///< of each item
  std::vector<Entry> binned_;  ///< as found, then sorted by bucket
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> start_;  ///< of each bucket, one more than buckets
  std::size_t mask_ = 0;
  Vec3 origin_ = Vec3::Zero();
};

template <class Visit>
void CellGrid::scan(int level, Run x, int cy, int cz, const Visit& visit) const {
  const auto look = [&](std::size_t from, std::size_t to) {
    for (std::size_t e = from; e < to; ++e) {
      const Entry& entry = entries_[e];
      if (entry.cell[0] >= x.first && entry.cell[0] <= x.last && entry.cell[1] == cy && entry.cell[2] == cz &&
          entry.level == level)
        visit(static_cast<std::size_t>(entry.item));
    }
  };
  if (static_cast<std::size_t>(x.last - x.first) >= mask_) return look(0, entries_.size());
  const std::size_t base = row(level, cy, cz);
  const std::size_t first = (base + static_cast<std::size_t>(x.first)) & mask_;
  const std::size_t last = (base + static_cast<std::size_t>(x.last)) & mask_;
  if (first <= last) return look(start_[first], start_[last + 1]);
  look(start_[first], entries_.size());
  look(0, start_[last + 1]);
}

template <class Visit>
void CellGrid::near(const Vec3& x, double reach, int deepest, const Visit& visit) const {
  for (int l = 0; l <= deepest; ++l) {
    const Level& level = levels_[static_cast<std::size_t>(l)];
    if (!level.used) continue;
    const Vec3 margin = Vec3::Constant(reach + level.half);
    const std::array<int, 3> low = cell_of(level, x - margin), high = cell_of(level, x + margin);
    Run run_x[2], run_y[2], run_z[2];
    const int in_x = runs(low[0], high[0], level.wrap[0], run_x);
    const int in_y = runs(low[1], high[1], level.wrap[1], run_y);
    const int in_z = runs(low[2], high[2], level.wrap[2], run_z);
    for (int rz = 0; rz < in_z; ++rz)
      for (int cz = run_z[rz].first; cz <= run_z[rz].last; ++cz)
        for (int ry = 0; ry < in_y; ++ry)
          for (int cy = run_y[ry].first; cy <= run_y[ry].last; ++cy)
            for (int rx = 0; rx < in_x; ++rx) scan(l, run_x[rx], cy, cz, visit);
  }
}

}  // namespace sluice
