#include "dem/pair_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "base/random.h"
#include "dem/dem_scenes.h"
#include "dem/faces.h"

namespace sluice {
namespace {

using namespace test;

struct Remembered {
  Vec3 spring, turned, surface_a, surface_b, normal;
  double clear;
  bool touching;
};

/// What each pair remembers, seen from the rock with the lower name.
std::map<std::pair<int, int>, Remembered> by_name(const PairList& list, const std::vector<int>& name) {
  std::map<std::pair<int, int>, Remembered> all;
  for (std::size_t i = 0; i < list.rock_count(); ++i)
    for (std::size_t p = list.start[i]; p < list.start[i + 1]; ++p) {
      const int a = name[i], b = name[static_cast<std::size_t>(list.second[p])];
      const PairMemory& m = list.memory[p];
      Remembered r{list.spring[p], list.turned[p], m.surface_a,          m.surface_b,
                   m.normal,       list.clear[p],  list.touching[p] != 0};
      if (a > b) {
        r.spring = -r.spring;
        r.turned = -r.turned;
        r.normal = -r.normal;
        r.surface_a.swap(r.surface_b);
      }
      all[std::minmax(a, b)] = r;
    }
  return all;
}

PairList random_list(int rocks, std::vector<Vec3>& x, std::vector<double>& reach, Random& random) {
  for (int i = 0; i < rocks; ++i) {
    x.emplace_back(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    reach.push_back(random.uniform(0.02, 0.08));
  }
  PairList list({.rolling = true, .superquadrics = true});
  list.rebuild(x, reach, {.box = {Vec3::Zero(), Vec3::Ones()}});
  for (std::size_t p = 0; p < list.pair_count(); ++p) {
    list.spring[p] = random.on_sphere();
    list.turned[p] = random.on_sphere();
    list.memory[p] = {random.on_sphere(), random.on_sphere(), random.on_sphere()};
    list.clear[p] = random.uniform();
    list.touching[p] = random.uniform() < 0.5;
  }
  return list;
}

TEST(PairList, RemembersEachPairWhateverTheOrderOfTheRocks) {
  Random random(3);
  std::vector<Vec3> x;
  std::vector<double> reach;
  constexpr int rocks = 700;
  PairList list = random_list(rocks, x, reach, random);
  ASSERT_GT(list.pair_count(), 1000u);
  std::vector<int> name(rocks);
  std::iota(name.begin(), name.end(), 0);
  const auto before = by_name(list, name);
  std::vector<int> new_index = name;
  for (std::size_t k = rocks; k-- > 1;) std::swap(new_index[k], new_index[random.next() % (k + 1)]);
  std::vector<Vec3> new_x(rocks);
  std::vector<double> new_reach(rocks);
  for (std::size_t i = 0; i < rocks; ++i) {
    const auto to = static_cast<std::size_t>(new_index[i]);
    name[to] = static_cast<int>(i);
    new_x[to] = x[i];
    new_reach[to] = reach[i];
  }
  list.reorder(new_index);
  list.rebuild(new_x, new_reach, {.box = {Vec3::Zero(), Vec3::Ones()}});
  const auto after = by_name(list, name);
  ASSERT_EQ(after.size(), before.size());
  for (const auto& [pair, was] : before) {
    const Remembered& is = after.at(pair);
    EXPECT_EQ(is.spring, was.spring);
    EXPECT_EQ(is.turned, was.turned);
    EXPECT_EQ(is.surface_a, was.surface_a);
    EXPECT_EQ(is.surface_b, was.surface_b);
    EXPECT_EQ(is.normal, was.normal);
    EXPECT_EQ(is.clear, was.clear);
    EXPECT_EQ(is.touching, was.touching);
  }
}

TEST(PairList, ListsBlockyRocksOnceForEachCopyAndKeepsTheCopiesApart) {
  Random random(6);
  std::vector<Vec3> x;
  std::vector<double> reach;
  constexpr int rocks = 600;
  const PairList plain = random_list(rocks, x, reach, random);
  const Domain domain{.box = {Vec3::Zero(), Vec3::Ones()}};
  std::vector<std::uint8_t> blocky(rocks);
  for (std::size_t i = 0; i < rocks; ++i) blocky[i] = i % 3 != 0;
  PairList list({.rolling = true, .superquadrics = true});
  list.rebuild(x, reach, domain, blocky);
  std::size_t expected = 0;
  for (std::size_t i = 0; i < plain.rock_count(); ++i)
    for (std::size_t p = plain.start[i]; p < plain.start[i + 1]; ++p)
      expected += blocky[i] && blocky[static_cast<std::size_t>(plain.second[p])] ? face_copies : 1;
  ASSERT_EQ(list.pair_count(), expected);
  // The place of each entry among those of its pair.
  const auto places = [](const PairList& of) {
    std::vector<double> place(of.pair_count(), 0);
    for (std::size_t i = 0; i < of.rock_count(); ++i)
      for (std::size_t p = of.start[i] + 1; p < of.start[i + 1]; ++p)
        if (of.second[p] == of.second[p - 1]) place[p] = place[p - 1] + 1;
    return place;
  };
  list.clear = places(list);
  std::vector<int> new_index(rocks);
  for (int i = 0; i < rocks; ++i) new_index[static_cast<std::size_t>(i)] = (7 * i + 3) % rocks;
  auto new_x = x;
  auto new_reach = reach;
  auto new_blocky = blocky;
  for (std::size_t i = 0; i < rocks; ++i) {
    const auto to = static_cast<std::size_t>(new_index[i]);
    new_x[to] = x[i];
    new_reach[to] = reach[i];
    new_blocky[to] = blocky[i];
  }
  list.reorder(new_index);
  EXPECT_EQ(list.clear, places(list));
  list.rebuild(new_x, new_reach, domain, new_blocky);
  ASSERT_EQ(list.pair_count(), expected);
  EXPECT_EQ(list.clear, places(list));
}

TEST(PairList, QueuesEachPairThatLeavesItsChunkWhereNoOtherChunkWrites) {
  Random random(4);
  std::vector<Vec3> x;
  std::vector<double> reach;
  const PairList list = random_list(1700, x, reach, random);
  const std::size_t queues = list.incoming.size();
  ASSERT_EQ(list.out_start.back(), queues);
  ASSERT_EQ(list.queue_start.size(), queues + 1);
  std::vector<std::size_t> goes_to(queues), most(queues, 0);
  std::vector<int> met(queues, 0);
  for (std::size_t c = 0; c + 1 < list.in_start.size(); ++c)
    for (std::size_t k = list.in_start[c]; k < list.in_start[c + 1]; ++k) {
      goes_to[list.incoming[k]] = c;
      ++met[list.incoming[k]];
      if (k > list.in_start[c]) {
        EXPECT_LT(list.incoming[k - 1], list.incoming[k]);
      }
    }
  EXPECT_EQ(std::count(met.begin(), met.end(), 1), static_cast<std::ptrdiff_t>(queues));
  for (std::size_t i = 0; i < list.rock_count(); ++i)
    for (std::size_t p = list.start[i]; p < list.start[i + 1]; ++p) {
      const auto j = static_cast<std::size_t>(list.second[p]);
      const std::size_t chunk = i / list.chunk_length();
      EXPECT_EQ(list.first[p], i);
      EXPECT_EQ(list.queue[p] != PairList::no_queue, list.crosses(i, j));
      if (!list.crosses(i, j)) continue;
      EXPECT_GE(list.queue[p], list.out_start[chunk]);
      EXPECT_LT(list.queue[p], list.out_start[chunk + 1]);
      EXPECT_EQ(goes_to[list.queue[p]], j / list.chunk_length());
      ++most[list.queue[p]];
    }
  for (std::size_t q = 0; q < queues; ++q) EXPECT_EQ(list.queue_start[q + 1] - list.queue_start[q], most[q]);
}

TEST(PairList, CutsFewRocksIntoShortChunksAndManyIntoLongOnes) {
  Random random(5);
  for (const auto& [rocks, length] : {std::pair{1, 32}, {500, 32}, {1100, 64}, {5000, 256}, {9000, 512}}) {
    std::vector<Vec3> x;
    for (int i = 0; i < rocks; ++i) x.push_back(random.on_sphere());
    const std::vector<double> reach(x.size(), 1e-3);
    PairList list({});
    list.rebuild(x, reach, {.box = {Vec3::Constant(-1), Vec3::Ones()}});
    EXPECT_EQ(list.chunk_length(), static_cast<std::size_t>(length)) << rocks;
  }
}

TEST(PairList, MissesNoContactOfMovingSuperquadrics) {
  DemScene scene =
      scene_of({0.6, 0.4, 0}, 0.02, {make_superquadric(1.4, 0.6, 4), make_superquadric(1.2, 0.9, 2.5)});
  scene.gravity.setZero();
  scene.domain.box = {Vec3::Zero(), Vec3::Constant(0.215)};
  for (int k = 0; k < 3; ++k)
    scene.domain.low[static_cast<std::size_t>(k)] = scene.domain.high[static_cast<std::size_t>(k)] =
        Face::periodic;
  const Walls none;
  DemSystem dem({}, scene, none);
  Random random(9);
  for (int i = 0; i < 343; ++i)
    dem.add({.x = 0.215 / 7 * Vec3(i % 7 + 0.5, i / 7 % 7 + 0.5, i / 49 + 0.5),
             .v = 4 * random.on_sphere(),
             .w = 50 * random.on_sphere(),
             .q = random.rotation(),
             .shape = i % 2,
             .size = 0.02});
  const double dt = dem.step_size();
  std::size_t seen = 0;
  for (int k = 0; k < 3000; ++k) {
    dem.step(k * dt, dt);
    if (k % 60 != 0) continue;
    const Rocks& r = dem.rocks();
    const auto body = [&](std::size_t i, const Vec3& at) {
      return Superquadric{at, r.q[i], dem.semi_axes(i),
                          dem.shapes()[static_cast<std::size_t>(r.shape[i])].blockiness};
    };
    std::size_t touching = 0;
    for (std::size_t i = 0; i < r.count(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Vec3 d = scene.domain.nearest_image(r.x[j] - r.x[i]);
        if (d.norm() >= r.radius[i] + r.radius[j]) continue;
        PairMemory memory;
        ContactGeometry geometry;
        const PairOutcome outcome = superquadric_pair(body(i, Vec3::Zero()), body(j, d), memory, geometry);
        touching += outcome != PairOutcome::separated && geometry.overlap > 0;
      }
    EXPECT_EQ(dem.contact_count(), touching) << "step " << k;
    seen += touching;
  }
  EXPECT_GT(seen, 500u);
}

}  // namespace
}  // namespace sluice
