#include "mpm/node_blocks.h"

#include <algorithm>

namespace sluice {

template <class Real>
NodeBlocks<Real>::NodeBlocks(const BlockLayout& layout)
    : layout_(&layout),
      slot_(static_cast<std::size_t>(layout.block_count()), BlockLayout::none),
      mark_(static_cast<std::size_t>(layout.block_count()), 0) {}

template <class Real>
void NodeBlocks<Real>::activate(const std::vector<PointBlock>& blocks,
                                const std::function<void(std::int32_t slot)>& prepare) {
  ++step_;
  wanted_.clear();
  const auto want = [&](std::int32_t block) {
    if (block == BlockLayout::none || mark_[static_cast<std::size_t>(block)] == step_) return;
    mark_[static_cast<std::size_t>(block)] = step_;
    wanted_.push_back(block);
  };
  for (const PointBlock& b : blocks) {
    const Vec3i place = layout_->block_place(b.block);
    for (int bit = 0; bit < 27; ++bit)
      if (b.reach >> bit & 1) want(layout_->neighbour(place, bit % 3 - 1, bit / 3 % 3 - 1, bit / 9 - 1));
  }
  std::sort(wanted_.begin(), wanted_.end());
  replace_active(prepare);
}

template <class Real>
void NodeBlocks<Real>::restore(const std::vector<std::int32_t>& blocks,
                               const std::function<void(std::int32_t slot)>& prepare) {
  ++step_;
  wanted_ = blocks;
  for (const std::int32_t block : wanted_) mark_[static_cast<std::size_t>(block)] = step_;
  replace_active(prepare);
}

template <class Real>
void NodeBlocks<Real>::replace_active(const std::function<void(std::int32_t slot)>& prepare) {
  if (wanted_ == active_) return;
  for (const std::int32_t block : active_) {
    if (mark_[static_cast<std::size_t>(block)] == step_) continue;
    std::int32_t& slot = slot_[static_cast<std::size_t>(block)];
    free_.push_back(slot);
    block_[static_cast<std::size_t>(slot)] = BlockLayout::none;
    slot = BlockLayout::none;
  }
  std::size_t fresh = 0;
  for (const std::int32_t block : wanted_)
    fresh += slot_[static_cast<std::size_t>(block)] == BlockLayout::none ? 1 : 0;
  make_room(block_.size() + fresh - std::min(fresh, free_.size()));
  for (const std::int32_t block : wanted_) {
    std::int32_t& slot = slot_[static_cast<std::size_t>(block)];
    if (slot != BlockLayout::none) continue;
    if (free_.empty()) {
      slot = static_cast<std::int32_t>(block_.size());
      block_.push_back(block);
      const std::size_t n = block_.size() * BlockLayout::nodes;
      data_.resize(n);
      blend_.resize(n);
      if (!void_.empty()) void_.resize(n);
      stencil_.resize(n);
      strain_slot_.push_back(BlockLayout::none);
    } else {
      slot = free_.back();
      free_.pop_back();
      block_[static_cast<std::size_t>(slot)] = block;
    }
    if (!void_.empty()) std::fill_n(held_void_fraction(slot), BlockLayout::nodes, Real(1));
    std::fill_n(stencil(slot), BlockLayout::nodes, BlockLayout::none);
    prepare(slot);
  }
  active_.swap(wanted_);
}

template <class Real>
void NodeBlocks<Real>::hold_void_fractions() {
  if (!void_.empty()) return;
  void_.reserve(data_.capacity());
  void_.resize(data_.size(), Real(1));
}

template <class Real>
void NodeBlocks<Real>::hold_strains() {
  std::size_t held = strain_.size() / BlockLayout::nodes;
  for (const std::int32_t block : active_) {
    std::int32_t& n = strain_slot_[static_cast<std::size_t>(slot_of(block))];
    if (n == wanted_strain) n = static_cast<std::int32_t>(held++);
  }
  const std::size_t nodes = held * BlockLayout::nodes;
  if (nodes > strain_.capacity()) strain_.reserve(strain_.empty() ? nodes : nodes + nodes / 16);
  strain_.resize(nodes);
}

/// Room for so many slots, and a sixteenth more when that is needed at all, not twice as much.
template <class Real>
void NodeBlocks<Real>::make_room(std::size_t slots) {
  if (slots * BlockLayout::nodes <= data_.capacity()) return;
  const std::size_t nodes = (data_.empty() ? slots : slots + slots / 16) * BlockLayout::nodes;
  data_.reserve(nodes);
  blend_.reserve(nodes);
  if (!void_.empty()) void_.reserve(nodes);
  stencil_.reserve(nodes);
}

template <class Real>
std::size_t NodeBlocks<Real>::memory_bytes() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return bytes(slot_) + bytes(block_) + bytes(free_) + bytes(active_) + bytes(wanted_) + bytes(mark_) +
         bytes(data_) + bytes(blend_) + bytes(void_) + bytes(stencil_) + bytes(strain_slot_) + bytes(strain_);
}

template class NodeBlocks<float>;
template class NodeBlocks<double>;

}  // namespace sluice
