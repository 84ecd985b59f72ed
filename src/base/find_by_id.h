#pragma once
/// Finds entries of a list by id when they are asked for in nearly the order in which they stand.

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace sluice {

class FindById {
 public:
  /// @param ids  no two alike; must outlive this
  explicit FindById(std::span<const std::uint64_t> ids) : ids_(ids) {}

  /// Place of `id` in the list, if it is there: a look at the entry after the last one found, and a search of
  /// a sorted index, made on first need, where that is another.
  std::optional<std::size_t> find(std::uint64_t id) {
    if (next_ < ids_.size() && ids_[next_] == id) return next_++;
    if (by_id_.empty()) {
      by_id_.resize(ids_.size());
      std::iota(by_id_.begin(), by_id_.end(), std::size_t{0});
      std::sort(by_id_.begin(), by_id_.end(),
                [&](std::size_t a, std::size_t b) { return ids_[a] < ids_[b]; });
    }
    const auto at = std::lower_bound(by_id_.begin(), by_id_.end(), id,
                                     [&](std::size_t a, std::uint64_t value) { return ids_[a] < value; });
    if (at == by_id_.end() || ids_[*at] != id) return std::nullopt;
    next_ = *at + 1;
    return *at;
  }

 private:
  std::span<const std::uint64_t> ids_;
  std::vector<std::size_t> by_id_;
  std::size_t next_ = 0;
};

}  // namespace sluice
