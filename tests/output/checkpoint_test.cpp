#include "output/checkpoint.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "base/errors.h"
#include "output/temporary_folder.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

struct State {
  double clock = 0;
  bool flag = false;
  std::string name;
  std::vector<Vec3> x;
  std::vector<Quat> q;
  std::vector<std::uint64_t> id;
  std::vector<float> nothing;
  std::vector<std::array<int, 3>> triples;

  void exchange(StateArchive& a) {
    a.value("clock", clock);
    a.enter("rocks");
    a.value("flag", flag);
    a.text("name", name);
    a.values("x", x);
    a.values("q", q);
    a.enter("list");
    a.values("id", id);
    a.values("nothing", nothing);
    a.values("triples", triples);
    a.leave();
    a.leave();
  }
};

State sample(double clock) {
  State s;
  s.clock = clock;
  s.flag = true;
  s.name = "a rock";
  s.nothing.clear();
  for (int k = 0; k < 1000; ++k) {
    s.x.emplace_back(0.1 * k, clock, -0.0);
    s.q.emplace_back(1, 0, 1e-300, k);
    s.id.push_back(~std::uint64_t{0} - static_cast<std::uint64_t>(k));
    s.triples.push_back({k, -k, 2 * k});
  }
  return s;
}

void save(const RunFolder& folder, double clock, const std::string& process = "p1") {
  State s = sample(clock);
  save_checkpoint(folder, {process, "sluice 0.1 abc", clock}, [&](StateArchive& a) { s.exchange(a); });
}

/// Turns one byte over in the middle of the file's data.
void damage(const fs::path& file) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekg(0, std::ios::end);
  const auto at = stream.tellg() / 2;
  stream.seekg(at);
  const char byte = static_cast<char>(stream.get() ^ 0x10);
  stream.seekp(at);
  stream.put(byte);
}

struct CheckpointTest : ::testing::Test {
  TemporaryFolder temporary;
  RunFolder folder{temporary.path};
  State back;
  RestoredCheckpoint load(const std::string& process = "p1") {
    return load_checkpoint(folder, process, [&](StateArchive& a) { back.exchange(a); });
  }
};

TEST_F(CheckpointTest, RestoresEveryBit) {
  save(folder, 0.1);
  const RestoredCheckpoint restored = load();
  const State s = sample(0.1);
  EXPECT_EQ(restored.stamp.time, 0.1);
  EXPECT_EQ(restored.stamp.program, "sluice 0.1 abc");
  EXPECT_TRUE(restored.notes.empty());
  EXPECT_EQ(back.clock, s.clock);
  EXPECT_EQ(back.flag, s.flag);
  EXPECT_EQ(back.name, s.name);
  ASSERT_EQ(back.x.size(), s.x.size());
  EXPECT_EQ(std::memcmp(back.x.data(), s.x.data(), s.x.size() * sizeof(Vec3)), 0);
  ASSERT_EQ(back.q.size(), s.q.size());
  EXPECT_EQ(std::memcmp(back.q.data(), s.q.data(), s.q.size() * sizeof(Quat)), 0);
  EXPECT_EQ(back.id, s.id);
  EXPECT_TRUE(back.nothing.empty());
  EXPECT_EQ(back.triples, s.triples);
}

TEST_F(CheckpointTest, KeepsTwoGenerationsAndRestoresTheNewer) {
  for (const double t : {1.0, 2.0, 3.0}) save(folder, t);
  EXPECT_EQ(load().stamp.time, 3.0);
  fs::remove(folder.checkpoint());  // as between the two renames
  EXPECT_EQ(load().stamp.time, 2.0);
  EXPECT_EQ(back.clock, 2.0);
  EXPECT_FALSE(fs::exists(folder.checkpoint().string() + ".tmp"));
}

TEST_F(CheckpointTest, GoesBackToTheOlderOneWhereTheNewestIsDamagedAndSaysSo) {
  save(folder, 1);
  save(folder, 2);
  damage(folder.checkpoint());
  const RestoredCheckpoint restored = load();
  EXPECT_EQ(restored.stamp.time, 1.0);
  EXPECT_EQ(back.clock, 1.0);
  ASSERT_EQ(restored.notes.size(), 1u);
  EXPECT_NE(restored.notes[0].find("damaged"), std::string::npos) << restored.notes[0];
  EXPECT_NE(restored.notes[0].find("checkpoint.previous.h5 at t = 1 s"), std::string::npos)
      << restored.notes[0];
}

TEST_F(CheckpointTest, FindsOutACutFile) {
  save(folder, 1);
  save(folder, 2);
  const auto whole = fs::file_size(folder.checkpoint());
  for (const double part : {0.0, 0.01, 0.3, 0.9, 0.999}) {
    fs::resize_file(folder.checkpoint(), static_cast<std::uintmax_t>(part * static_cast<double>(whole)));
    EXPECT_EQ(load().stamp.time, 1.0) << part;
    fs::remove(folder.checkpoint());
    save(folder, 2);  // checkpoint.previous.h5 stays, for there is nothing to move
  }
}

TEST_F(CheckpointTest, RestoresNothingFromTwoDamagedFiles) {
  save(folder, 1);
  save(folder, 2);
  damage(folder.checkpoint());
  damage(folder.previous_checkpoint());
  EXPECT_THROW(load(), EnvironmentError);
  EXPECT_TRUE(back.x.empty());
}

TEST_F(CheckpointTest, RefusesAnotherProcess) {
  save(folder, 1);
  EXPECT_THROW(load("p2"), InputError);
  EXPECT_TRUE(back.x.empty());
}

TEST_F(CheckpointTest, SaysThatThereIsNone) {
  EXPECT_FALSE(find_checkpoint(folder));
  EXPECT_THROW(load(), EnvironmentError);
}

TEST_F(CheckpointTest, IsFoundWithoutBeingRestored) {
  save(folder, 4);
  const auto found = find_checkpoint(folder);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->stamp.time, 4.0);
}

TEST_F(CheckpointTest, RefusesAStateThatDoesNotFit) {
  save(folder, 1);
  double other = 0;
  std::vector<float> narrow;
  EXPECT_THROW(load_checkpoint(folder, "p1", [&](StateArchive& a) { a.value("other", other); }),
               EnvironmentError);
  EXPECT_THROW(load_checkpoint(folder, "p1", [&](StateArchive& a) { a.values("clock", narrow); }),
               EnvironmentError);
}

TEST_F(CheckpointTest, KeepsTheOldOneIfTheStateThrowsWhileBeingSaved) {
  save(folder, 1);
  const CheckpointStamp stamp{"p1", "", 2};
  EXPECT_THROW(save_checkpoint(folder, stamp, [](StateArchive&) { throw std::runtime_error("no"); }),
               std::runtime_error);
  EXPECT_EQ(load().stamp.time, 1.0);
  EXPECT_FALSE(fs::exists(folder.checkpoint().string() + ".tmp"));
}

TEST_F(CheckpointTest, SaysWhyItCannotBeWritten) {
  State s = sample(1);
  const RunFolder nowhere{temporary.path / "none"};
  try {
    save_checkpoint(nowhere, {"p1", "", 1}, [&](StateArchive& a) { s.exchange(a); });
    FAIL() << "a checkpoint was written into a folder that is not there";
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sluice
