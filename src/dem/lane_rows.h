#pragma once
/// Rows of memory as lanes: from one row a lane to one vector a column, and back.

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "base/vec.h"
#include "dem/lanes.h"

namespace sluice::lanes {

using LaneIndices = std::array<std::uint32_t, kLanes>;
using Rows = std::array<const double*, kLanes>;
/// Eight doubles of each lane's row, as columns.
using Columns = std::array<Lanes, 8>;

/// Four doubles of each lane's row, as columns.
struct Quads {
  Triple<Lanes> first;
  Lanes last;
};

#if defined(__AVX512F__)

/// Turns a square of eight by eight over its diagonal: three rounds of a perfect shuffle.
inline void transpose(Columns& c) {
  for (int round = 0; round < 3; ++round) {
    Columns next;
    for (std::size_t k = 0; k < 4; ++k) {
      next[2 * k] = __builtin_shufflevector(c[k], c[k + 4], 0, 8, 1, 9, 2, 10, 3, 11);
      next[2 * k + 1] = __builtin_shufflevector(c[k], c[k + 4], 4, 12, 5, 13, 6, 14, 7, 15);
    }
    c = next;
  }
}

inline Columns load_columns(const Rows& rows) {
  Columns c;
  for (std::size_t k = 0; k < 8; ++k) std::memcpy(&c[k], rows[k], sizeof(Lanes));
  transpose(c);
  return c;
}

/// Rows of the first `count` lanes.
inline void store_columns(Columns c, const std::array<double*, kLanes>& rows, std::size_t count) {
  transpose(c);
  for (std::size_t k = 0; k < count; ++k) std::memcpy(rows[k], &c[k], sizeof(Lanes));
}

using HalfLanes = double __attribute__((vector_size(32)));

/// Four rows a side, rows k and k + 4 in one register.
inline Quads turn(const std::array<Lanes, 4>& z) {
  const Lanes xz_01 = __builtin_shufflevector(z[0], z[1], 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes xz_23 = __builtin_shufflevector(z[2], z[3], 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes yw_01 = __builtin_shufflevector(z[0], z[1], 1, 9, 3, 11, 5, 13, 7, 15);
  const Lanes yw_23 = __builtin_shufflevector(z[2], z[3], 1, 9, 3, 11, 5, 13, 7, 15);
  return {{__builtin_shufflevector(xz_01, xz_23, 0, 1, 8, 9, 4, 5, 12, 13),
           __builtin_shufflevector(yw_01, yw_23, 0, 1, 8, 9, 4, 5, 12, 13),
           __builtin_shufflevector(xz_01, xz_23, 2, 3, 10, 11, 6, 7, 14, 15)},
          __builtin_shufflevector(yw_01, yw_23, 2, 3, 10, 11, 6, 7, 14, 15)};
}

inline Quads load_quads(const Rows& rows) {
  std::array<Lanes, 4> z;
  for (std::size_t k = 0; k < 4; ++k) {
    HalfLanes low, high;
    std::memcpy(&low, rows[k], sizeof low);
    std::memcpy(&high, rows[k + 4], sizeof high);
    z[k] = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  }
  return turn(z);
}

/// Three doubles of each lane's row.
inline Triple<Lanes> load_triples(const Rows& rows) {
  std::array<Lanes, 4> z;
  for (std::size_t k = 0; k < 4; ++k) {
    const HalfLanes low = _mm256_maskz_loadu_pd(7, rows[k]), high = _mm256_maskz_loadu_pd(7, rows[k + 4]);
    z[k] = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  }
  return turn(z).first;
}

/// Three doubles to the row of each of the first `count` lanes.
inline void store_triples(const Triple<Lanes>& t, const std::array<double*, kLanes>& rows,
                          std::size_t count) {
  // To rows k and k + 4 in one register.
  const Lanes none{};
  const Lanes xy_01 = __builtin_shufflevector(t.x, t.y, 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes xy_23 = __builtin_shufflevector(t.x, t.y, 1, 9, 3, 11, 5, 13, 7, 15);
  const Lanes z_01 = __builtin_shufflevector(t.z, none, 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes z_23 = __builtin_shufflevector(t.z, none, 1, 9, 3, 11, 5, 13, 7, 15);
  const std::array<Lanes, 4> z{__builtin_shufflevector(xy_01, z_01, 0, 1, 8, 9, 4, 5, 12, 13),
                               __builtin_shufflevector(xy_23, z_23, 0, 1, 8, 9, 4, 5, 12, 13),
                               __builtin_shufflevector(xy_01, z_01, 2, 3, 10, 11, 6, 7, 14, 15),
                               __builtin_shufflevector(xy_23, z_23, 2, 3, 10, 11, 6, 7, 14, 15)};
  for (std::size_t k = 0; k < count; ++k) {
    const Lanes& both = z[k % 4];
    const HalfLanes half = k < 4 ? __builtin_shufflevector(both, both, 0, 1, 2, 3)
                                 : __builtin_shufflevector(both, both, 4, 5, 6, 7);
    _mm256_mask_storeu_pd(rows[k], 7, half);
  }
}

/// One bit a lane.
inline unsigned bits_of(LaneMask mask) {
  return _mm512_cmplt_epi64_mask(reinterpret_cast<__m512i>(mask), __m512i{});
}

/// Writes the lanes chosen by `bits` one after the other; kLanes places at `to` may be overwritten.
inline void store_chosen(Lanes x, unsigned bits, double* to) {
  const Lanes chosen = _mm512_maskz_compress_pd(static_cast<__mmask8>(bits), x);
  std::memcpy(to, &chosen, sizeof chosen);
}
inline void store_chosen(const LaneIndices& x, unsigned bits, std::uint32_t* to) {
  __m256i all;
  std::memcpy(&all, x.data(), sizeof all);
  all = _mm256_maskz_compress_epi32(static_cast<__mmask8>(bits), all);
  std::memcpy(to, &all, sizeof all);
}

#else

inline Columns load_columns(const Rows& rows) {
  Columns c;
  for (std::size_t k = 0; k < 8; ++k)
    for (std::size_t lane = 0; lane < kLanes; ++lane) c[k][lane] = rows[lane][k];
  return c;
}

inline void store_columns(const Columns& c, const std::array<double*, kLanes>& rows, std::size_t count) {
  for (std::size_t lane = 0; lane < count; ++lane)
    for (std::size_t k = 0; k < 8; ++k) rows[lane][k] = c[k][lane];
}

inline Quads load_quads(const Rows& rows) {
  Quads q;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    q.first.x[lane] = rows[lane][0];
    q.first.y[lane] = rows[lane][1];
    q.first.z[lane] = rows[lane][2];
    q.last[lane] = rows[lane][3];
  }
  return q;
}

inline unsigned bits_of(LaneMask mask) {
  unsigned bits = 0;
  for (unsigned lane = 0; lane < kLanes; ++lane) bits |= (mask[lane] != 0 ? 1u : 0u) << lane;
  return bits;
}

inline void store_chosen(Lanes x, unsigned bits, double* to) {
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    if ((bits >> lane & 1) != 0) *to++ = x[lane];
}
inline void store_chosen(const LaneIndices& x, unsigned bits, std::uint32_t* to) {
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    if ((bits >> lane & 1) != 0) *to++ = x[lane];
}

inline Triple<Lanes> load_triples(const Rows& rows) {
  Triple<Lanes> t;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    t.x[lane] = rows[lane][0];
    t.y[lane] = rows[lane][1];
    t.z[lane] = rows[lane][2];
  }
  return t;
}

inline void store_triples(const Triple<Lanes>& t, const std::array<double*, kLanes>& rows,
                          std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    rows[k][0] = t.x[k];
    rows[k][1] = t.y[k];
    rows[k][2] = t.z[k];
  }
}

#endif

inline Triple<Lanes> load_triples(const std::vector<Vec3>& base, const LaneIndices& at) {
  Rows rows;
  for (std::size_t k = 0; k < kLanes; ++k) rows[k] = base[at[k]].data();
  return load_triples(rows);
}

/// Gives the first `count` lanes to their vectors.
inline void store_triples(const Triple<Lanes>& t, std::vector<Vec3>& base, const LaneIndices& at,
                          std::size_t count) {
  std::array<double*, kLanes> rows;
  for (std::size_t k = 0; k < kLanes; ++k) rows[k] = base[at[k]].data();
  store_triples(t, rows, count);
}

}  // namespace sluice::lanes
