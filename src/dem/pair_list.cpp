#include "dem/pair_list.h"

#include <algorithm>
#include <bit>

#include "base/parallel.h"
#include "dem/faces.h"

namespace sluice {

namespace {
constexpr std::size_t rocks_per_search = 256;
constexpr std::size_t memory_columns = 9;
}  // namespace

void PairList::resize_memories(std::size_t pairs) {
  touching.assign(pairs, 0);
  spring.assign(pairs, Vec3::Zero());
  if (contents_.rolling) turned.assign(pairs, Vec3::Zero());
  if (contents_.rings) rings.assign(pairs, no_stretch());
  if (!contents_.superquadrics) return;
  memory.assign(pairs, {});
  clear.assign(pairs, 0);
}

void PairList::copy_memory(const PairList& from, std::size_t old_pair, std::size_t new_pair) {
  touching[new_pair] = from.touching[old_pair];
  spring[new_pair] = from.spring[old_pair];
  if (contents_.rolling) turned[new_pair] = from.turned[old_pair];
  if (contents_.rings) rings[new_pair] = from.rings[old_pair];
  if (!contents_.superquadrics) return;
  memory[new_pair] = from.memory[old_pair];
  clear[new_pair] = from.clear[old_pair];
}

void PairList::find(std::span<const Vec3> x, std::span<const double> reach, const Domain& domain,
                    std::span<const std::uint8_t> blocky) {
  const std::size_t n = x.size();
  grid.build(x, reach, domain);
  found_.resize(std::max(found_.size(), (n + rocks_per_search - 1) / rocks_per_search));
  for (auto& chunk : found_) chunk.clear();
  const bool periodic = domain.any_periodic();
  parallel_chunks(n, rocks_per_search, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const int level = grid.level(i);
      grid.near(x[i], reach[i], level, [&](std::size_t j) {
        if (grid.level(j) == level && j <= i) return;
        Vec3 d = x[j] - x[i];
        if (periodic) d = domain.nearest_image(d);
        const double far = reach[i] + reach[j];
        if (d.squaredNorm() >= far * far) return;
        const std::size_t copies = !blocky.empty() && blocky[i] != 0 && blocky[j] != 0 ? face_copies : 1;
        found_[c].insert(found_[c].end(), copies,
                         {static_cast<int>(std::min(i, j)), static_cast<int>(std::max(i, j))});
      });
    }
  });
  start.assign(n + 1, 0);
  for (const auto& chunk : found_)
    for (const auto& pair : chunk) ++start[static_cast<std::size_t>(pair[0]) + 1];
  for (std::size_t i = 0; i < n; ++i) start[i + 1] += start[i];
  second.resize(start[n]);
  std::vector<std::uint32_t> next(start.begin(), start.end());
  for (const auto& chunk : found_)
    for (const auto& pair : chunk) second[next[static_cast<std::size_t>(pair[0])]++] = pair[1];
  parallel_for(n,
               [&](std::size_t i) { std::sort(second.begin() + start[i], second.begin() + start[i + 1]); });
}

void PairList::give_queues() {
  const std::size_t n = rock_count();
  chunk_length_ = std::clamp(std::bit_floor(n / enough_chunks), shortest_chunk, longest_chunk);
  const std::size_t chunks = (n + chunk_length_ - 1) / chunk_length_;
  first.resize(second.size());
  queue.assign(second.size(), no_queue);
  out_start.assign(1, 0);
  queue_start.assign(1, 0);
  std::vector<std::uint32_t> to;                   // chunk that each queue goes to
  std::vector<std::uint32_t> crossing(chunks, 0);  // pairs of this chunk that go there
  std::vector<std::uint32_t> number(chunks, 0);    // of the queue
  std::vector<std::uint32_t> goes;                 // chunks that any go to
  for (std::size_t c = 0; c < chunks; ++c) {
    const std::size_t begin = c * chunk_length_, end = std::min(n, begin + chunk_length_);
    const auto chunk_of = [&](std::size_t p) { return static_cast<std::size_t>(second[p]) / chunk_length_; };
    goes.clear();
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t p = start[i]; p < start[i + 1]; ++p) {
        first[p] = static_cast<std::uint32_t>(i);
        if (const std::size_t other = chunk_of(p); other != c && crossing[other]++ == 0)
          goes.push_back(static_cast<std::uint32_t>(other));
      }
    std::sort(goes.begin(), goes.end());
    for (const std::uint32_t other : goes) {
      number[other] = static_cast<std::uint32_t>(to.size());
      to.push_back(other);
      queue_start.push_back(queue_start.back() + crossing[other]);
      crossing[other] = 0;
    }
    for (std::size_t p = start[begin]; p < start[end]; ++p)
      if (const std::size_t other = chunk_of(p); other != c) queue[p] = number[other];
    out_start.push_back(static_cast<std::uint32_t>(to.size()));
  }
  in_start.assign(chunks + 2, 0);
  for (const std::uint32_t other : to) ++in_start[other + 2];
  for (std::size_t c = 0; c < chunks; ++c) in_start[c + 2] += in_start[c + 1];
  incoming.resize(to.size());
  for (std::size_t q = 0; q < to.size(); ++q) incoming[in_start[to[q] + 1]++] = static_cast<std::uint32_t>(q);
  in_start.pop_back();
}

void PairList::rebuild(std::span<const Vec3> x, std::span<const double> reach, const Domain& domain,
                       std::span<const std::uint8_t> blocky) {
  PairList old(contents_);
  old.start.swap(start);
  old.second.swap(second);
  old.touching.swap(touching);
  old.spring.swap(spring);
  old.turned.swap(turned);
  old.rings.swap(rings);
  old.memory.swap(memory);
  old.clear.swap(clear);
  find(x, reach, domain, blocky);
  resize_memories(second.size());
  parallel_for(std::min(old.rock_count(), x.size()), [&](std::size_t i) {
    std::size_t o = old.start[i];
    for (std::size_t p = start[i]; p < start[i + 1]; ++p) {
      while (o < old.start[i + 1] && old.second[o] < second[p]) ++o;
      if (o < old.start[i + 1] && old.second[o] == second[p]) copy_memory(old, o++, p);
    }
  });
  give_queues();
}

void PairList::renumber(std::span<const int> new_index, std::size_t new_count) {
  std::vector<std::uint32_t> new_start(1, 0);
  new_start.reserve(new_count + 1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rock_count(); ++i) {
    if (new_index[i] < 0) continue;
    for (std::size_t p = start[i]; p < start[i + 1]; ++p) {
      const int j = new_index[static_cast<std::size_t>(second[p])];
      if (j < 0) continue;
      copy_memory(*this, p, kept);
      second[kept++] = j;
    }
    new_start.push_back(static_cast<std::uint32_t>(kept));
  }
  start.swap(new_start);
  second.resize(kept);
  touching.resize(kept);
  spring.resize(kept);
  if (contents_.rolling) turned.resize(kept);
  if (contents_.rings) rings.resize(kept);
  if (contents_.superquadrics) {
    memory.resize(kept);
    clear.resize(kept);
  }
  give_queues();
}

void PairList::reorder(std::span<const int> new_index) {
  struct Entry {
    int second;
    std::uint32_t old_pair;
    bool turned_round;
  };
  start.resize(new_index.size() + 1, start.back());  // rocks added since have no pairs yet
  const std::size_t n = rock_count();
  std::vector<std::uint32_t> new_start(n + 1, 0);
  const auto places = [&](std::size_t i, std::size_t p) {
    return std::minmax(new_index[i], new_index[static_cast<std::size_t>(second[p])]);
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t p = start[i]; p < start[i + 1]; ++p)
      ++new_start[static_cast<std::size_t>(places(i, p).first) + 1];
  for (std::size_t i = 0; i < n; ++i) new_start[i + 1] += new_start[i];
  std::vector<Entry> entries(second.size());
  std::vector<std::uint32_t> next(new_start.begin(), new_start.end());
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t p = start[i]; p < start[i + 1]; ++p) {
      const auto [low, high] = places(i, p);
      entries[next[static_cast<std::size_t>(low)]++] = {high, static_cast<std::uint32_t>(p),
                                                        low != new_index[i]};
    }
  parallel_for(n, [&](std::size_t i) {
    std::sort(entries.begin() + new_start[i], entries.begin() + new_start[i + 1],
              [](const Entry& a, const Entry& b) {
                return a.second != b.second ? a.second < b.second : a.old_pair < b.old_pair;
              });
  });
  PairList old(contents_);
  old.touching.swap(touching);
  old.spring.swap(spring);
  old.turned.swap(turned);
  old.rings.swap(rings);
  old.memory.swap(memory);
  old.clear.swap(clear);
  resize_memories(entries.size());
  for (std::size_t p = 0; p < entries.size(); ++p) {
    second[p] = entries[p].second;
    copy_memory(old, entries[p].old_pair, p);
    if (!entries[p].turned_round) continue;
    spring[p] = -spring[p];
    if (contents_.rolling) turned[p] = -turned[p];
    for (Vec3& stretch : rings_of(p)) stretch = -stretch;
    if (contents_.superquadrics) memory[p].turn_round();
  }
  start.swap(new_start);
  give_queues();
}

void PairList::exchange(StateArchive& archive) {
  archive.enter("pairs");
  archive.values("start", start);
  archive.values("second", second);
  archive.values("touching", touching);
  archive.values("spring", spring);
  archive.values("turned", turned);
  archive.values("rings", rings);
  archive.values("clear", clear);
  std::vector<std::array<double, memory_columns>> rows(memory.size());
  for (std::size_t p = 0; p < memory.size(); ++p) {
    const PairMemory& m = memory[p];
    Eigen::Map<Vec3>(rows[p].data()) = m.surface_a;
    Eigen::Map<Vec3>(rows[p].data() + 3) = m.surface_b;
    Eigen::Map<Vec3>(rows[p].data() + 6) = m.normal;
  }
  archive.values("memory", rows);
  archive.leave();
  if (!archive.loading()) return;
  memory.assign(rows.size(), {});
  for (std::size_t p = 0; p < rows.size(); ++p) {
    memory[p].surface_a = Eigen::Map<const Vec3>(rows[p].data());
    memory[p].surface_b = Eigen::Map<const Vec3>(rows[p].data() + 3);
    memory[p].normal = Eigen::Map<const Vec3>(rows[p].data() + 6);
  }
  give_queues();
}

std::size_t PairList::memory_bytes() const {
  std::size_t bytes = grid.memory_bytes();
  bytes += (start.capacity() + out_start.capacity() + in_start.capacity() + incoming.capacity() +
            queue_start.capacity()) *
           sizeof(std::uint32_t);
  bytes += clear.capacity() * sizeof(double);
  bytes += (first.capacity() + queue.capacity()) * sizeof(std::uint32_t);
  bytes += second.capacity() * sizeof(int) + touching.capacity();
  bytes += rings.capacity() * sizeof(rings[0]);
  bytes += (spring.capacity() + turned.capacity()) * sizeof(Vec3) + memory.capacity() * sizeof(PairMemory);
  for (const auto& chunk : found_) bytes += chunk.capacity() * sizeof(chunk[0]);
  return bytes;
}

}  // namespace sluice
