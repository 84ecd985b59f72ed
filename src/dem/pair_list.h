#pragma once
/// Pairs of rocks that may touch before any of them has moved half the skin, and what each pair
/// remembers. Rows by the lower index i, each sorted by the higher index j: the order depends on
/// nothing but the rocks, so sums over it are the same for any number of threads.
///
/// Two blocky rocks are listed face_copies times in a row (faces.h), one entry for each copy of one of them;
/// the order of the copies stays.
///
/// Rocks are cut into chunks, so many that threads have enough to share, up to `longest_chunk` rocks each: a
/// function of how many rocks are listed, not of the threads. A chunk adds the forces of its pairs to its own
/// rocks at once; the reaction on a rock of another chunk waits in a queue that no other chunk writes, long
/// enough for all pairs that cross from the one to the other:
///
///     rocks     [ 0 ... 511 ][ 512 ... 1023 ][ ...       queues of chunk 0: out_start[0] ... out_start[1]
///     pair (7, 600) of chunk 0 crosses: queue q          received by chunk 1: among incoming[in_start[1]
///     ...]
///
/// so no force is written by two threads, and each rock's sum has one order.

#include <cstdint>
#include <span>
#include <vector>

#include "base/domain.h"
#include "base/state_archive.h"
#include "dem/cell_grid.h"
#include "dem/partial_slip.h"
#include "dem/superquadric_contact.h"

namespace sluice {

/// What a scene needs remembered for each pair.
struct PairContents {
  bool rolling = false;        ///< some pair of materials has rolling resistance
  bool rings = false;          ///< some pair of materials slips from the rim of its contacts inwards
  bool superquadrics = false;  ///< some shape is not a sphere
};

class PairList {
 public:
  static constexpr std::size_t shortest_chunk = 32, longest_chunk = 512, enough_chunks = 16;
  static constexpr std::uint32_t no_queue = 0xffffffff;

  explicit PairList(PairContents contents) : contents_(contents) {
    start.assign(1, 0);
    give_queues();
  }

  /// Finds all pairs closer than the sum of their reaches [m]; what old pairs remember is kept.
  /// @param blocky  1 for rocks with faces; empty where there are none
  void rebuild(std::span<const Vec3> x, std::span<const double> reach, const Domain& domain,
               std::span<const std::uint8_t> blocky = {});
  /// Drops rocks with new_index -1 and renumbers the others (order kept).
  void renumber(std::span<const int> new_index, std::size_t new_count);
  /// Renumbers all rocks in any order; a pair whose rocks change places sees what it remembers from the
  /// other side.
  void reorder(std::span<const int> new_index);
  void exchange(StateArchive& archive);
  std::size_t memory_bytes() const;

  /// Of pair p; empty where no pair has any.
  std::span<Vec3> rings_of(std::size_t p) {
    return rings.empty() ? std::span<Vec3>{} : std::span<Vec3>(rings[p]);
  }
  std::size_t pair_count() const { return second.size(); }
  std::size_t rock_count() const { return start.size() - 1; }

  std::vector<std::uint32_t> start;    ///< #rocks + 1: pairs of rock i are start[i] .. start[i + 1]
  std::vector<std::uint32_t> first;    ///< #pairs: i
  std::vector<int> second;             ///< #pairs: j > i
  std::vector<std::uint32_t> queue;    ///< #pairs: of the reaction on j; no_queue where j is of i's chunk
  std::vector<std::uint8_t> touching;  ///< #pairs
  std::vector<Vec3> spring;            ///< #pairs: tangential stretch [m]
  std::vector<Vec3> turned;            ///< #pairs or empty: rolling history [rad]
  std::vector<std::array<Vec3, shear_rings>> rings;  ///< #pairs or empty: stretch of each ring [m]
  std::vector<PairMemory> memory;                    ///< #pairs or empty: superquadric warm start
  std::vector<double> clear;             ///< #pairs or empty: they cannot touch before coming this closer [m]
  std::vector<std::uint32_t> out_start;  ///< #chunks + 1: queues that leave a chunk, by where they go
  std::vector<std::uint32_t> in_start;   ///< #chunks + 1: queues that a chunk receives ...
  std::vector<std::uint32_t> incoming;   ///< ... by ascending number
  std::vector<std::uint32_t> queue_start;  ///< #queues + 1: first place of each
  CellGrid grid;                           ///< of the last rebuild

  /// Rocks in a chunk, the last one apart.
  std::size_t chunk_length() const { return chunk_length_; }
  bool crosses(std::size_t i, std::size_t j) const { return i / chunk_length_ != j / chunk_length_; }

 private:
  void find(std::span<const Vec3> x, std::span<const double> reach, const Domain& domain,
            std::span<const std::uint8_t> blocky);
  void give_queues();
  void resize_memories(std::size_t pairs);
  void copy_memory(const PairList& from, std::size_t old_pair, std::size_t new_pair);

  PairContents contents_;
  std::size_t chunk_length_ = shortest_chunk;
  std::vector<std::vector<std::array<int, 2>>> found_;  ///< scratch, by chunk
};

}  // namespace sluice
