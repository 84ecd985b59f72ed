#include "mpm/point_store.h"

#include <algorithm>

#include "base/parallel.h"

namespace sluice {

namespace {
/// A step with a stray costs about three times one with a resident; a sort about as much as a step.
constexpr double strays_before_sort = 0.05;
constexpr std::size_t bins_per_chunk = 8;

/// Neighbours that the stencil of a cell reaches, for a block of the given width.
std::uint32_t reach_of(int local, const Vec3i& width) {
  std::uint32_t reach = 0;
  const int c[3] = {local & 3, (local >> 2) & 3, (local >> 4) & 3};
  int lo[3], hi[3];
  for (int axis = 0; axis < 3; ++axis) {
    lo[axis] = c[axis] == 0 ? -1 : 0;
    hi[axis] = c[axis] == width[axis] - 1 ? 1 : 0;
  }
  for (int dz = lo[2]; dz <= hi[2]; ++dz)
    for (int dy = lo[1]; dy <= hi[1]; ++dy)
      for (int dx = lo[0]; dx <= hi[0]; ++dx) reach |= 1U << (dx + 1 + 3 * (dy + 1) + 9 * (dz + 1));
  return reach;
}
}  // namespace

template <class Real>
PointStore<Real>::PointStore(const BlockLayout& layout)
    : layout_(&layout),
      bin_begin_{0},
      index_of_block_(static_cast<std::size_t>(layout.block_count()), BlockLayout::none) {
  static_assert(sizeof(Point) == 20 * sizeof(Real));
  for (int local = 0; local < 64; ++local)
    reach_of_cell_[static_cast<std::size_t>(local)] = reach_of(local, Vec3i::Constant(BlockLayout::edge));
}

template <class Real>
void PointStore<Real>::add(const Point& point, std::int32_t cell_key, std::uint64_t point_id,
                           double point_mass, double point_fines) {
  if (point_fines != 0 && fines.empty()) fines.assign(points.size(), 0.0);
  points.push_back(point);
  before.push_back({point.x[0], point.x[1], point.x[2]});
  key.push_back(cell_key);
  id.push_back(point_id);
  mass.push_back(point_mass);
  if (!fines.empty() || point_fines != 0) fines.push_back(point_fines);
}

template <class Real>
void PointStore<Real>::remove(std::size_t slot) {
  key[slot] = BlockLayout::none;
  ++dead_;
}

template <class Real>
void PointStore<Real>::bin() {
  find_strays();
  const std::size_t unsorted = strays_.size() + dead_;
  if (unsorted > 64 && static_cast<double>(unsorted) > strays_before_sort * static_cast<double>(slots())) {
    sort();
    find_strays();
  }
  list_strays();
}

/// Fills strays_ (in storage order) and the reach of each bin's residents.
template <class Real>
void PointStore<Real>::find_strays() {
  const std::size_t bins = bin_block_.size();
  if (strays_of_bin_.size() < bins) strays_of_bin_.resize(bins);
  reach_of_bin_.assign(bins, 0);
  parallel_for(
      bins,
      [&](std::size_t b) {
        strays_of_bin_[b].clear();
        const std::int32_t block = bin_block_[b];
        const Vec3i width = layout_->width(layout_->block_place(block));
        const bool full = width == Vec3i::Constant(BlockLayout::edge);
        std::uint32_t reach = 0;
        for (std::uint32_t slot = bin_begin_[b]; slot < bin_begin_[b + 1]; ++slot) {
          const std::int32_t cell = key[slot];
          if (cell >> 6 == block)
            reach |= full ? reach_of_cell_[static_cast<std::size_t>(cell & 63)] : reach_of(cell & 63, width);
          else if (cell != BlockLayout::none)
            strays_of_bin_[b].push_back(slot);
        }
        reach_of_bin_[b] = reach;
      },
      bins_per_chunk);
  strays_.clear();
  for (std::size_t b = 0; b < bins; ++b)
    strays_.insert(strays_.end(), strays_of_bin_[b].begin(), strays_of_bin_[b].end());
  for (std::size_t slot = bin_begin_.back(); slot < slots(); ++slot)
    if (alive(slot)) strays_.push_back(static_cast<std::uint32_t>(slot));
}

/// Groups strays by the block they are in now; writes blocks_.
template <class Real>
void PointStore<Real>::list_strays() {
  for (const PointBlock& b : blocks_) index_of_block_[static_cast<std::size_t>(b.block)] = BlockLayout::none;
  blocks_.clear();
  const auto open = [&](std::int32_t block) -> PointBlock& {
    std::int32_t& index = index_of_block_[static_cast<std::size_t>(block)];
    if (index == BlockLayout::none) {
      index = static_cast<std::int32_t>(blocks_.size());
      blocks_.push_back({});
      blocks_.back().block = block;
    }
    return blocks_[static_cast<std::size_t>(index)];
  };
  for (std::size_t b = 0; b < bin_block_.size(); ++b) {
    if (reach_of_bin_[b] == 0) continue;
    PointBlock& block = open(bin_block_[b]);
    block.begin = bin_begin_[b];
    block.end = bin_begin_[b + 1];
    block.reach = reach_of_bin_[b];
  }
  for (const std::uint32_t slot : strays_) {
    PointBlock& block = open(key[slot] >> 6);
    const Vec3i width = layout_->width(layout_->block_place(block.block));
    block.reach |= reach_of(key[slot] & 63, width);
    ++block.stray_end;
  }
  std::uint32_t next = 0;
  for (PointBlock& b : blocks_) {
    b.stray_begin = next;
    next += b.stray_end;
    b.stray_end = b.stray_begin;
  }
  place_.resize(strays_.size());
  for (const std::uint32_t slot : strays_)
    place_[blocks_[static_cast<std::size_t>(index_of_block(key[slot] >> 6))].stray_end++] = slot;
  strays_.swap(place_);
}

template <class Real>
void PointStore<Real>::order_by_cell(const PointBlock& block, CellOrder& out) const {
  std::array<std::uint32_t, BlockLayout::nodes> count{};
  for_each(block, [&](std::uint32_t slot) { ++count[static_cast<std::size_t>(key[slot] & 63)]; });
  out.begin[0] = 0;
  for (std::size_t c = 0; c < count.size(); ++c) {
    out.begin[c + 1] = out.begin[c] + count[c];
    count[c] = out.begin[c];
  }
  out.slot.resize(out.begin.back());
  for_each(block,
           [&](std::uint32_t slot) { out.slot[count[static_cast<std::size_t>(key[slot] & 63)]++] = slot; });
}

template <class Real>
void PointStore<Real>::sort() {
  // Blocks in ascending order, each with its residents and strays counted.
  list_strays();
  std::vector<PointBlock> sorted = blocks_;
  std::sort(sorted.begin(), sorted.end(),
            [](const PointBlock& a, const PointBlock& b) { return a.block < b.block; });
  std::vector<std::uint32_t> live(sorted.size());
  parallel_for(
      sorted.size(),
      [&](std::size_t b) {
        std::uint32_t n = sorted[b].stray_end - sorted[b].stray_begin;
        for (std::uint32_t slot = sorted[b].begin; slot < sorted[b].end; ++slot)
          n += resident(slot, sorted[b].block) ? 1 : 0;
        live[b] = n;
      },
      bins_per_chunk);
  std::vector<std::uint32_t> begin(sorted.size() + 1, 0);
  for (std::size_t b = 0; b < sorted.size(); ++b) begin[b + 1] = begin[b] + live[b];

  // Within a block: by cell, and in the former order within a cell.
  place_.resize(begin.back());
  parallel_for(
      sorted.size(),
      [&](std::size_t b) {
        std::array<std::uint32_t, 65> next{};
        for_each(sorted[b],
                 [&](std::uint32_t slot) { ++next[static_cast<std::size_t>(key[slot] & 63) + 1]; });
        next[0] = begin[b];
        for (std::size_t c = 0; c < 64; ++c) next[c + 1] += next[c];
        for_each(sorted[b], [&](std::uint32_t slot) {
          place_[next[static_cast<std::size_t>(key[slot] & 63)]++] = slot;
        });
      },
      bins_per_chunk);

  const auto reorder = [&](auto& column, auto& spare) {
    spare.resize(place_.size());
    parallel_for(
        place_.size(), [&](std::size_t n) { spare[n] = column[place_[n]]; }, 4096);
    column.swap(spare);
  };
  reorder(points, spare_points_);
  reorder(before, spare_before_);
  reorder(key, spare_key_);
  reorder(id, spare_id_);
  reorder(mass, spare_column_);
  if (!fines.empty()) reorder(fines, spare_column_);
  dead_ = 0;
  bin_block_.resize(sorted.size());
  for (std::size_t b = 0; b < sorted.size(); ++b) bin_block_[b] = sorted[b].block;
  bin_begin_ = std::move(begin);
}

template <class Real>
std::size_t PointStore<Real>::memory_bytes() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t strays = 0;
  for (const auto& list : strays_of_bin_) strays += bytes(list);
  return bytes(points) + bytes(before) + bytes(key) + bytes(id) + bytes(mass) + bytes(fines) +
         bytes(spare_points_) + bytes(spare_before_) + bytes(spare_key_) + bytes(spare_id_) +
         bytes(spare_column_) + bytes(strays_) + bytes(place_) + strays + bytes(blocks_) +
         bytes(index_of_block_) + bytes(bin_block_) + bytes(bin_begin_);
}

template <class Real>
void PointStore<Real>::exchange(StateArchive& archive) {
  archive.values("points", points);
  archive.values("before", before);
  archive.values("key", key);
  archive.values("id", id);
  archive.values("mass", mass);
  archive.values("fines", fines);
  archive.values("bin_block", bin_block_);
  archive.values("bin_begin", bin_begin_);
  if (archive.loading())
    dead_ = static_cast<std::size_t>(std::count(key.begin(), key.end(), BlockLayout::none));
}

template class PointStore<float>;
template class PointStore<double>;

}  // namespace sluice
