#pragma once
/// Pairs of rocks that may touch before any of them has moved half the skin, and what each pair
/// remembers. Rows by the lower index i, each sorted by the higher index j: the order depends on
/// nothing but the rocks, so sums over it are the same for any number of threads.

#include <cstdint>
#include <span>
#include <vector>

#include "base/domain.h"
#include "base/state_archive.h"
#include "dem/cell_grid.h"
#include "dem/superquadric_contact.h"

namespace sluice {

/// What a scene needs remembered for each pair.
struct PairContents {
  bool rolling = false;        ///< some pair of materials has rolling resistance
  bool superquadrics = false;  ///< some shape is not a sphere
};

class PairList {
 public:
  explicit PairList(PairContents contents) : contents_(contents) { start.assign(1, 0); }

  /// Finds all pairs closer than both radii plus `skin` [m]; what old pairs remember is kept.
  void rebuild(std::span<const Vec3> x, std::span<const double> radius, double skin, const Domain& domain);
  /// Drops rocks with new_index -1 and renumbers the others (order kept).
  void renumber(std::span<const int> new_index, std::size_t new_count);
  void exchange(StateArchive& archive);
  std::size_t memory_bytes() const;

  std::size_t pair_count() const { return second.size(); }
  std::size_t rock_count() const { return start.size() - 1; }

  std::vector<std::uint32_t> start;     ///< #rocks + 1: pairs of rock i are start[i] .. start[i + 1]
  std::vector<int> second;              ///< #pairs: j > i
  std::vector<std::uint8_t> touching;   ///< #pairs
  std::vector<Vec3> spring;             ///< #pairs: tangential stretch [m]
  std::vector<Vec3> turned;             ///< #pairs or empty: rolling history [rad]
  std::vector<PairMemory> memory;       ///< #pairs or empty: superquadric warm start
  std::vector<std::uint32_t> in_start;  ///< #rocks + 1: the pairs in which rock j is the second ...
  std::vector<std::uint32_t> in_pair;   ///< ... by ascending i
  CellGrid grid;                        ///< of the last rebuild

 private:
  void find(std::span<const Vec3> x, std::span<const double> radius, double skin, const Domain& domain);
  void transpose();
  void resize_memories(std::size_t pairs);
  void copy_memory(const PairList& from, std::size_t old_pair, std::size_t new_pair);

  PairContents contents_;
  std::vector<double> reach_;                           ///< scratch
  std::vector<std::vector<std::array<int, 2>>> found_;  ///< scratch, by chunk
};

}  // namespace sluice
