#include "inflow/outlets.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/memory_archive.h"
#include "inflow/emitters.h"
#include "inflow/map_schema.h"

namespace sluice {
namespace {

using namespace test;

TEST(OutletRow, SharesTheWaterAndLeavesOutWhatIsBlocked) {
  FakeFluid fluid(spacing);
  PipeJetConfig c = pipe(0);
  c.outlets.flow.reset();
  c.outlets.total_flow = 0.03;
  c.outlets.count = 4;
  c.outlets.spacing = Vec3(0, 0.5, 0);
  c.outlets.blocked = {2};
  EXPECT_DOUBLE_EQ(c.outlets.flow_each(), 0.01);
  const auto jet = make_pipe_jet(c, into(fluid));
  feed(*jet, 100, 1e-3);
  std::vector<int> at(4);
  for (const Vec3& x : fluid.points().x) ++at[static_cast<std::size_t>(std::lround(x.y() / 0.5))];
  EXPECT_EQ(at[1], 0);
  EXPECT_GT(at[0], 900);
  EXPECT_LE(std::abs(at[0] - at[3]), 1);
  EXPECT_LE(std::abs(at[0] - at[2]), 1);
  EXPECT_NEAR(jet->water().requested, 3.0, 1e-9);
  EXPECT_LT(jet->water().waiting, 1.000001e-3);
}

TEST(OutletRow, RunsBetweenStartAndStop) {
  FakeFluid fluid(spacing);
  PipeJetConfig c = pipe(0.02);
  c.outlets.start = 0.05;
  c.outlets.stop = 0.1;
  const auto jet = make_pipe_jet(c, into(fluid));
  feed(*jet, 50, 1e-3);
  EXPECT_EQ(fluid.count(), 0u);
  feed(*jet, 150, 1e-3, 0.05);
  EXPECT_NEAR(jet->water().requested, 1.0, 1e-9);
}

TEST(OutletRow, ContinuesBitForBitAfterARestart) {
  FakeFluid whole(spacing), cut(spacing);
  const auto a = make_pipe_jet(pipe(0.02), into(whole));
  const auto b = make_pipe_jet(pipe(0.02), into(cut));
  const auto c = make_pipe_jet(pipe(0.02), into(cut));
  feed(*a, 100, 1e-3);
  feed(*b, 50, 1e-3);
  MemoryArchive archive;
  b->exchange(archive);
  archive.rewind_to_load();
  c->exchange(archive);
  for (int i = 50; i < 100; ++i) c->advance(i * 1e-3, 1e-3);
  ASSERT_EQ(whole.count(), cut.count());
  for (std::size_t i = 0; i < whole.count(); ++i) EXPECT_EQ(whole.points().x[i], cut.points().x[i]);
  EXPECT_EQ(a->water().entered, c->water().entered);
}

TEST(OutletRowKeys, AskForOneFlow) {
  MapSchema none, both;
  both.numbers_given = {{"flow", 0.01}, {"total_flow", 0.1}};
  PipeJetConfig a, b;
  a.keys(none);
  b.keys(both);
  EXPECT_TRUE(none.complains_about("flow"));
  EXPECT_TRUE(both.complains_about("total_flow"));
}

TEST(OutletRowKeys, RefuseARowInOnePlaceAndUnknownOutlets) {
  MapSchema s;
  s.numbers_given = {{"count", 3}, {"flow", 0.01}};
  s.number_lists["blocked"] = {4};
  PipeJetConfig c;
  c.keys(s);
  EXPECT_TRUE(s.complains_about("spacing"));
  EXPECT_TRUE(s.complains_about("blocked"));
}

TEST(OutletRowKeys, RefuseARowThatIsAllBlocked) {
  MapSchema s;
  s.numbers_given = {{"flow", 0.01}};
  s.number_lists["blocked"] = {1};
  PipeJetConfig c;
  c.keys(s);
  EXPECT_TRUE(s.complains_about("blocked"));
}

}  // namespace
}  // namespace sluice
