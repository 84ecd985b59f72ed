#include "base/memory_archive.h"

#include <gtest/gtest.h>

#include <array>

#include "base/errors.h"

namespace sluice {
namespace {

struct Thing {
  double clock = 0;
  bool wet = false;
  std::uint64_t seed = 0;
  std::string name;
  std::vector<Vec3> x;
  std::vector<std::int32_t> order;
  Quat turn = Quat::Identity();
  Mat3 affine = Mat3::Zero();
  std::array<float, 3> weights{};

  void exchange(StateArchive& a) {
    a.enter("thing");
    a.value("clock", clock);
    a.value("wet", wet);
    a.value("seed", seed);
    a.text("name", name);
    a.values("x", x);
    a.values("order", order);
    a.enter("pose");
    a.value("turn", turn);
    a.value("affine", affine);
    a.leave();
    a.value("weights", weights);
    a.leave();
  }
};

Thing a_thing() {
  Thing t{0.1 + 0.2, true, 0xfedcba9876543210u, "lip", {{1, 2, 3}, {4, 5, 6}}, {3, 1, 2},
          {},        {},   {1.f, 2.f, 3.f}};
  t.turn = Quat(0.5, -0.5, 0.5, 0.5);
  t.affine << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  return t;
}

TEST(MemoryArchive, RestoresEveryBit) {
  Thing saved = a_thing();
  MemoryArchive archive;
  saved.exchange(archive);
  Thing restored;
  restored.x.resize(9);
  archive.rewind_to_load();
  restored.exchange(archive);
  EXPECT_EQ(restored.clock, saved.clock);
  EXPECT_EQ(restored.wet, saved.wet);
  EXPECT_EQ(restored.seed, saved.seed);
  EXPECT_EQ(restored.name, saved.name);
  EXPECT_EQ(restored.x, saved.x);
  EXPECT_EQ(restored.order, saved.order);
  EXPECT_EQ(restored.turn.coeffs(), saved.turn.coeffs());
  EXPECT_EQ(restored.affine, saved.affine);
  EXPECT_EQ(restored.weights, saved.weights);
}

TEST(MemoryArchive, TwoOfTheSameStateAreEqual) {
  MemoryArchive a, b;
  Thing one = a_thing(), two = a_thing();
  one.exchange(a);
  two.exchange(b);
  EXPECT_TRUE(a == b);
  two.order[1] = 7;
  b.clear();
  two.exchange(b);
  EXPECT_FALSE(a == b);
}

TEST(MemoryArchive, KeepsEmptyLists) {
  std::vector<double> none, filled{1, 2};
  MemoryArchive archive;
  archive.values("none", none);
  archive.rewind_to_load();
  archive.values("none", filled);
  EXPECT_TRUE(filled.empty());
}

TEST(MemoryArchive, RefusesAnotherNameTypeOrLength) {
  double clock = 1;
  std::vector<double> three{1, 2, 3};
  MemoryArchive archive;
  archive.value("clock", clock);
  archive.values("three", three);
  archive.rewind_to_load();
  float narrow = 0;
  EXPECT_THROW(archive.value("clock", narrow), EnvironmentError);
  EXPECT_THROW(archive.value("watch", clock), EnvironmentError);
  EXPECT_THROW(archive.value("three", clock), EnvironmentError);
  Vec3 row = Vec3::Zero();
  EXPECT_THROW(archive.value("three", row), EnvironmentError);
}

TEST(MemoryArchive, CountsItsBytes) {
  std::vector<Vec3> x(10, Vec3::Zero());
  MemoryArchive archive;
  archive.values("x", x);
  EXPECT_EQ(archive.bytes(), 240u);
}

}  // namespace
}  // namespace sluice
