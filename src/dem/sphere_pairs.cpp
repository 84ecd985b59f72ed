/// The listed pairs of a chunk of spheres that meet, found as many at a time as the processor has lanes.

#include <algorithm>
#include <cstring>

#include "dem/dem_state.h"
#include "dem/lane_rows.h"

namespace sluice {

namespace {

using lanes::all_lanes;
using lanes::any;
using lanes::kLanes;
using lanes::LaneIndices;
using lanes::LaneMask;
using lanes::Lanes;
using lanes::store_chosen;
using LaneTriple = lanes::Triple<Lanes>;

static_assert(MeetingSpheres::spare >= kLanes);
static_assert(sizeof(RockPlaceRow) == 4 * sizeof(double));

/// As Domain::nearest_image, of one axis.
void bring_near(Lanes& d, double length) {
  const LaneMask far = lanes::absolute(d) > 0.5 * length;
  if (!any(far)) return;
  for (std::size_t k = 0; k < kLanes; ++k)
    if (far[k] != 0) d[k] -= length * std::nearbyint(d[k] / length);
}

/// Of kLanes flags, one bit each.
unsigned bits_of_flags(const std::uint8_t* flags) {
  unsigned bits = 0;
  if constexpr (kLanes == 8) {
    // Each flag, 0 or 1, moves from bit 8 k to bit 56 + k.
    std::uint64_t all;
    std::memcpy(&all, flags, sizeof all);
    bits = static_cast<unsigned>(all * 0x0102040810204080ULL >> 56);
  } else {
    for (unsigned k = 0; k < kLanes; ++k) bits |= static_cast<unsigned>(flags[k]) << k;
  }
  return bits;
}

}  // namespace

void MeetingSpheres::make_room(std::size_t most) {
  count = 0;
  if (pair.size() >= most + spare) return;
  for (auto* column : {&x, &y, &z, &radius_i, &radius_j}) column->resize(most + spare);
  for (auto* column : {&pair, &i, &j}) column->resize(most + spare);
}

void MeetingSpheres::add(const Candidate& candidate, double radius_of_i, double radius_of_j) {
  x[count] = candidate.separation.x();
  y[count] = candidate.separation.y();
  z[count] = candidate.separation.z();
  radius_i[count] = radius_of_i;
  radius_j[count] = radius_of_j;
  pair[count] = candidate.pair;
  i[count] = candidate.i;
  j[count++] = candidate.j;
}

void MeetingSpheres::repeat_last() {
  if (count == 0) return;
  const auto repeat = [&](auto& column) {
    std::fill_n(column.begin() + static_cast<std::ptrdiff_t>(count), spare, column[count - 1]);
  };
  for (auto* column : {&x, &y, &z, &radius_i, &radius_j}) repeat(*column);
  for (auto* column : {&pair, &i, &j}) repeat(*column);
}

void DemSystem::Implementation::keep_rows(std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    places[i] = {rocks.x[i], rocks.radius[i]};
    motions[i] = {rocks.v[i], rocks.mass[i], rocks.w[i], rocks.size[i]};
  }
}

void DemSystem::Implementation::find_spheres(DemChunk& chunk, PairScratch& scratch, std::size_t end) {
  constexpr std::size_t ahead = 48;  // pairs: by then the second rock has come from memory
  const std::size_t from = pairs.start[scratch.begin], to = pairs.start[end];
  const Vec3 length = scene.domain.box.size();
  MeetingSpheres& found = scratch.spheres;
  found.make_room(to - from);
  // Compiled twice: for as many pairs as there are lanes, and for those left over.
  const auto look_at = [&](std::size_t p, std::size_t count) __attribute__((always_inline)) {
    LaneIndices at, i, j;
    lanes::Rows row_i, row_j;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const std::size_t one = p + std::min(k, count - 1);
      at[k] = static_cast<std::uint32_t>(one);
      i[k] = pairs.first[one];
      j[k] = static_cast<std::uint32_t>(pairs.second[one]);
      row_i[k] = places[i[k]].x.data();
      row_j[k] = places[j[k]].x.data();
    }
    if (p + ahead + kLanes <= to)
      for (std::size_t k = 0; k < kLanes; ++k)
        __builtin_prefetch(&places[static_cast<std::size_t>(pairs.second[p + ahead + k])]);
    const lanes::Quads a = lanes::load_quads(row_i), b = lanes::load_quads(row_j);
    LaneTriple separation = b.first - a.first;
    if (scene.domain.periodic(0)) bring_near(separation.x, length.x());
    if (scene.domain.periodic(1)) bring_near(separation.y, length.y());
    if (scene.domain.periodic(2)) bring_near(separation.z, length.z());
    const Lanes reach = a.last + b.last;
    const unsigned real = (1u << count) - 1;
    const unsigned meet = lanes::bits_of(dot(separation, separation) < reach * reach) & real;

    unsigned touched = 0;
    if (count == kLanes)
      touched = bits_of_flags(&pairs.touching[p]);
    else
      for (unsigned k = 0; k < count; ++k) touched |= static_cast<unsigned>(pairs.touching[p + k]) << k;
    for (unsigned parted = touched & ~meet; parted != 0; parted &= parted - 1) {
      const auto k = static_cast<std::size_t>(__builtin_ctz(parted));
      end_pair(chunk, i[k], at[k]);
    }

    const std::size_t n = found.count;
    store_chosen(separation.x, meet, &found.x[n]);
    store_chosen(separation.y, meet, &found.y[n]);
    store_chosen(separation.z, meet, &found.z[n]);
    store_chosen(a.last, meet, &found.radius_i[n]);
    store_chosen(b.last, meet, &found.radius_j[n]);
    store_chosen(at, meet, &found.pair[n]);
    store_chosen(i, meet, &found.i[n]);
    store_chosen(j, meet, &found.j[n]);
    found.count += static_cast<std::size_t>(__builtin_popcount(meet));
  };
  std::size_t p = from;
  for (; p + kLanes <= to; p += kLanes) look_at(p, kLanes);
  if (p < to) look_at(p, to - p);
  found.repeat_last();
}

}  // namespace sluice
