#pragma once
/// Lets threads add to the nodes of a grid, with sums in one order whatever their number: items are sorted
/// by the slab of cells that they lie in. An item of slab k reaches the planes k and k + 1 alone, so that
/// slabs two apart never meet; within a slab items come by index.

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"

namespace sluice {

class SlabOrder {
 public:
  /// @param slab_of  of item i: 0 .. slabs - 1, or -1 to leave it out
  template <class SlabOf>
  void sort(std::size_t items, std::size_t slabs, const SlabOf& slab_of);
  std::span<const std::uint32_t> slab(std::size_t s) const {
    return {items_.data() + begin_[s], begin_[s + 1] - begin_[s]};
  }
  std::size_t memory_bytes() const {
    return (slab_of_.capacity() + items_.capacity() + place_.capacity()) * sizeof(std::uint32_t);
  }

 private:
  std::vector<std::int32_t> slab_of_;
  std::vector<std::uint32_t> items_, place_;  // place_: next free, #chunks x slabs
  std::vector<std::size_t> begin_;
};

template <class SlabOf>
void SlabOrder::sort(std::size_t items, std::size_t slabs, const SlabOf& slab_of) {
  constexpr std::size_t chunk = 4096;
  const std::size_t chunks = (items + chunk - 1) / chunk;
  slab_of_.resize(items);
  place_.assign(chunks * slabs, 0);
  parallel_chunks(items, chunk, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      slab_of_[i] = slab_of(i);
      if (slab_of_[i] >= 0) ++place_[c * slabs + static_cast<std::size_t>(slab_of_[i])];
    }
  });
  begin_.assign(slabs + 1, 0);
  std::uint32_t next = 0;
  for (std::size_t s = 0; s < slabs; ++s) {
    for (std::size_t c = 0; c < chunks; ++c) {
      const std::uint32_t here = place_[c * slabs + s];
      place_[c * slabs + s] = next;
      next += here;
    }
    begin_[s + 1] = next;
  }
  items_.resize(next);
  parallel_chunks(items, chunk, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (slab_of_[i] >= 0)
        items_[place_[c * slabs + static_cast<std::size_t>(slab_of_[i])]++] = static_cast<std::uint32_t>(i);
  });
}

}  // namespace sluice
