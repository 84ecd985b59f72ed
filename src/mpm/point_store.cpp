#include "mpm/point_store.h"

#include <algorithm>
#include <cstring>

#include "base/parallel.h"

namespace sluice {

namespace {
/// A step with a stray costs about three times one with a resident; a sort about as much as a step.
constexpr double strays_before_sort = 0.05;
constexpr std::size_t bins_per_chunk = 8;

/// Neighbours that the stencil of a cell reaches, for a block of the given width.
std::uint32_t reach_of(int local, const Vec3i& width) {
  const int c[3] = {local & 3, (local >> 2) & 3, (local >> 4) & 3};
  std::uint32_t reach = 1;
  for (int axis = 0, stride = 1; axis < 3; ++axis, stride *= 3) {
    const std::uint32_t below = c[axis] == 0 ? 1 : 0, above = c[axis] == width[axis] - 1 ? 1 : 0;
    reach *= below | 1U << stride | above << 2 * stride;  // bits of one axis never carry into another's
  }
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
  if (points.size() == points.capacity()) {
    const std::size_t room = points.size() + points.size() / 32 + 1024;  // a little more, not twice as much
    points.reserve(room);
    before.reserve(room);
    misfit.reserve(room);
    key.reserve(room);
    id.reserve(room);
    mass.reserve(room);
  }
  points.push_back(point);
  before.push_back({point.x[0], point.x[1], point.x[2]});
  misfit.emplace_back();
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
  order_by_cell();
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
  stray_place_.resize(strays_.size());
  for (const std::uint32_t slot : strays_)
    stray_place_[blocks_[static_cast<std::size_t>(index_of_block(key[slot] >> 6))].stray_end++] = slot;
  strays_.swap(stray_place_);
}

/// Writes order_: block by block, within a block by cell, and in the former order within a cell.
template <class Real>
void PointStore<Real>::order_by_cell() {
  const std::size_t blocks = blocks_.size();
  cell_begin_.resize(blocks);
  parallel_for(
      blocks,
      [&](std::size_t b) {
        auto& begin = cell_begin_[b];
        begin.fill(0);
        for_each(blocks_[b],
                 [&](std::uint32_t slot) { ++begin[static_cast<std::size_t>(key[slot] & 63) + 1]; });
        for (std::size_t c = 0; c < BlockLayout::nodes; ++c) begin[c + 1] += begin[c];
      },
      bins_per_chunk);
  std::uint32_t all = 0;
  for (auto& begin : cell_begin_) {
    const std::uint32_t count = begin.back();
    for (std::uint32_t& c : begin) c += all;
    all += count;
  }
  if (order_.size() < all) order_.resize(points.capacity());
  parallel_for(
      blocks,
      [&](std::size_t b) {
        auto next = cell_begin_[b];
        for_each(blocks_[b], [&](std::uint32_t slot) {
          order_[next[static_cast<std::size_t>(key[slot] & 63)]++] = slot;
        });
      },
      bins_per_chunk);
}

template <class Real>
void PointStore<Real>::sort() {
  // Blocks in ascending order.
  list_strays();
  std::sort(blocks_.begin(), blocks_.end(),
            [](const PointBlock& a, const PointBlock& b) { return a.block < b.block; });
  order_by_cell();
  bin_block_.resize(blocks_.size());
  bin_begin_.assign(1, 0);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    bin_block_[b] = blocks_[b].block;
    bin_begin_.push_back(cell_begin_[b].back());
  }

  const std::size_t count = bin_begin_.back();
  reorder(misfit);
  reorder(key);
  reorder(id);
  reorder(mass);
  if (!fines.empty()) reorder(fines);
  reorder_points();  // uses order_ up
  before.resize(count);
  parallel_for(
      count,
      [&](std::size_t n) {
        before[n] = {points[n].x[0], points[n].x[1], points[n].x[2]};
      },
      4096);
  dead_ = 0;
}

/// Puts a column into the order of order_. A step begins: what `before` held is history, so that its memory
/// lends itself.
template <class Real>
template <class T>
void PointStore<Real>::reorder(std::vector<T>& column) {
  static_assert(sizeof(T) <= sizeof(Place));
  const std::size_t count = bin_begin_.back();
  char* lent = reinterpret_cast<char*>(before.data());
  parallel_for(
      count, [&](std::size_t n) { std::memcpy(lent + sizeof(T) * n, &column[order_[n]], sizeof(T)); }, 4096);
  column.resize(count);
  parallel_for(
      count, [&](std::size_t n) { std::memcpy(&column[n], lent + sizeof(T) * n, sizeof(T)); }, 4096);
}

/// The same for the points, as many at a time as the lent memory holds. Those that stand where a piece goes
/// but belong behind it move to where others came from; their entry in order_, no longer needed, then says
/// where.
template <class Real>
void PointStore<Real>::reorder_points() {
  const std::size_t count = bin_begin_.back();
  std::vector<bool> waits(slots(), false);  // per place: a point that has yet to move
  for (std::size_t n = 0; n < count; ++n) waits[order_[n]] = true;
  char* lent = reinterpret_cast<char*>(before.data());
  const std::size_t piece = std::max<std::size_t>(1, before.size() * sizeof(Place) / sizeof(Point));
  for (std::size_t begin = 0; begin < count; begin += piece) {
    const std::size_t end = std::min(count, begin + piece);
    parallel_for(
        end - begin,
        [&](std::size_t n) {
          std::uint32_t& from = order_[begin + n];
          while (from < begin) from = order_[from];
          std::memcpy(lent + sizeof(Point) * n, &points[from], sizeof(Point));
        },
        4096);
    for (std::size_t n = begin; n < end; ++n) waits[order_[n]] = false;
    std::size_t next = begin;  // place after the last one whose point came from behind
    std::vector<std::array<std::uint32_t, 2>> moves;
    for (std::size_t place = begin; place < end; ++place) {
      if (!waits[place]) continue;
      while (order_[next] < end) ++next;
      moves.push_back({static_cast<std::uint32_t>(place), order_[next++]});
    }
    for (const auto& [from, to] : moves) {
      points[to] = points[from];
      order_[from] = to;
      waits[to] = true;
    }
    parallel_for(
        end - begin,
        [&](std::size_t n) { std::memcpy(&points[begin + n], lent + sizeof(Point) * n, sizeof(Point)); },
        4096);
  }
  points.resize(count);
}

template <class Real>
std::size_t PointStore<Real>::memory_bytes() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t strays = 0;
  for (const auto& list : strays_of_bin_) strays += bytes(list);
  return bytes(points) + bytes(before) + bytes(misfit) + bytes(key) + bytes(id) + bytes(mass) + bytes(fines) +
         bytes(strays_) + bytes(stray_place_) + bytes(order_) + bytes(cell_begin_) + strays + bytes(blocks_) +
         bytes(index_of_block_) + bytes(bin_block_) + bytes(bin_begin_) + bytes(reach_of_bin_);
}

template <class Real>
void PointStore<Real>::exchange(StateArchive& archive) {
  archive.values("points", points);
  archive.values("before", before);
  archive.values("misfit", misfit);
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
