/// What the lanes of contacts do with rows, and the spheres that they find.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "dem/dem_scenes.h"
#include "dem/lane_rows.h"

namespace sluice {
namespace {

using namespace test;
using lanes::kLanes;
using lanes::LaneIndices;
using lanes::Lanes;
constexpr auto lane_count = static_cast<std::size_t>(kLanes);

TEST(Lanes, HoldAColumnEachOfFourNumbersOfTheirRows) {
  Random random(1);
  std::vector<std::array<double, 4>> table(20);
  for (auto& row : table)
    for (double& x : row) x = random.uniform(-1, 1);
  lanes::Rows rows;
  std::array<std::size_t, lane_count> at;
  for (std::size_t k = 0; k < lane_count; ++k) {
    at[k] = (7 * k + 3) % table.size();
    rows[k] = table[at[k]].data();
  }
  const lanes::Quads q = lanes::load_quads(rows);
  for (std::size_t k = 0; k < lane_count; ++k) {
    EXPECT_EQ(q.first.x[k], table[at[k]][0]);
    EXPECT_EQ(q.first.y[k], table[at[k]][1]);
    EXPECT_EQ(q.first.z[k], table[at[k]][2]);
    EXPECT_EQ(q.last[k], table[at[k]][3]);
  }
}

TEST(Lanes, GiveTheirVectorsBackAndTouchNothingElse) {
  const double untouched = -7;
  for (std::size_t count = 0; count <= lane_count; ++count) {
    std::array<std::array<double, 5>, lane_count> table;
    lanes::Triple<Lanes> t;
    std::array<double*, lane_count> rows;
    for (std::size_t k = 0; k < lane_count; ++k) {
      table[k].fill(untouched);
      rows[k] = table[k].data() + 1;
      t.x[k] = static_cast<double>(k);
      t.y[k] = 100.0 + static_cast<double>(k);
      t.z[k] = 200.0 + static_cast<double>(k);
    }
    lanes::store_triples(t, rows, count);
    for (std::size_t k = 0; k < lane_count; ++k) {
      const double n = static_cast<double>(k);
      const std::array<double, 5> given{untouched, n, 100 + n, 200 + n, untouched};
      const std::array<double, 5> kept{untouched, untouched, untouched, untouched, untouched};
      EXPECT_EQ(table[k], k < count ? given : kept);
    }
  }
}

TEST(Lanes, PackTheChosenOnesInTheirOrder) {
  Lanes x;
  LaneIndices index;
  for (std::size_t k = 0; k < lane_count; ++k) {
    x[k] = 0.5 + static_cast<double>(k);
    index[k] = 10 + static_cast<std::uint32_t>(k);
  }
  for (unsigned bits = 0; bits < 1u << kLanes; ++bits) {
    std::array<double, lane_count> numbers{};
    std::array<std::uint32_t, lane_count> indices{};
    lanes::store_chosen(x, bits, numbers.data());
    lanes::store_chosen(index, bits, indices.data());
    std::size_t next = 0;
    lanes::LaneMask mask;
    for (std::size_t k = 0; k < lane_count; ++k) {
      mask[k] = (bits >> k & 1) != 0 ? -1 : 0;
      if (mask[k] == 0) continue;
      EXPECT_EQ(numbers[next], x[k]);
      EXPECT_EQ(indices[next++], index[k]);
    }
    EXPECT_EQ(lanes::bits_of(mask), bits);
  }
}

TEST(Lanes, TakeRootsToTwoUnitsInTheLastPlace) {
  Random random(2);
  for (int n = 0; n < 20000; ++n) {
    Lanes x;
    for (std::size_t k = 0; k < lane_count; ++k) x[k] = std::exp(random.uniform(-600, 600));
    x[0] = n == 0 ? 0 : x[0];
    const Lanes root = lanes::quick_root(x);
    for (std::size_t k = 0; k < lane_count; ++k)
      EXPECT_NEAR(root[k], std::sqrt(x[k]), 4.5e-16 * std::sqrt(x[k])) << x[k];
  }
}

/// Any number of pairs, so that some do not fill the lanes; rocks beside and across periodic faces.
TEST(Spheres, TouchThoseThatASearchOfAllPairsFinds) {
  Random random(3);
  std::size_t all = 0;
  for (int rocks = 1; rocks <= 60; ++rocks) {
    DemScene scene = scene_of({0.5, 0.3, 0}, 0.02);
    scene.smallest_size = 0.01;
    scene.gravity.setZero();
    scene.domain.box = {Vec3::Zero(), Vec3(0.08, 0.09, 0.1)};
    for (const std::size_t k : {0u, 2u}) scene.domain.low[k] = scene.domain.high[k] = Face::periodic;
    DemConfig config;
    config.overlap_limit = 4;  // small ones lie inside large ones
    const Walls none;
    DemSystem dem(config, scene, none);
    for (int i = 0; i < rocks; ++i) {
      const Vec3 x(random.uniform(0, 0.08), random.uniform(0, 0.09), random.uniform(0, 0.1));
      dem.add({.x = x, .size = random.uniform(0.01, 0.02)});
    }
    dem.step(0, 0);
    const Rocks& r = dem.rocks();
    std::size_t expected = 0;
    for (std::size_t i = 0; i < r.count(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (scene.domain.nearest_image(r.x[i] - r.x[j]).norm() < r.radius[i] + r.radius[j]) ++expected;
    EXPECT_EQ(dem.contact_count(), expected) << rocks << " rocks";
    all += expected;
  }
  EXPECT_GT(all, 500u);
}

}  // namespace
}  // namespace sluice
