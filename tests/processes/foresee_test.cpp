#include "processes/foresee.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "processes/build_parts.h"

namespace sluice {
namespace {

/// What `sluice check` says of a scene of the extremes with these settings.
std::vector<std::string> said_of(const std::string& scene, const std::vector<std::string>& settings = {}) {
  const std::filesystem::path file =
      std::filesystem::path(SLUICE_ROOT) / "validation" / "extremes" / "scenes" / scene;
  const ProcessConfig config = read_process(file, settings);
  return foreseen(config, build_parts(config).parts);
}

/// Whether one sentence holds all of these words.
bool says(const std::vector<std::string>& sentences, const std::vector<std::string>& words) {
  return std::any_of(sentences.begin(), sentences.end(), [&](const std::string& sentence) {
    return std::all_of(words.begin(), words.end(),
                       [&](const std::string& word) { return sentence.find(word) != std::string::npos; });
  });
}

TEST(Foresight, HasNothingToSayOfAModerateScene) {
  for (const char* scene : {"pit.yaml", "tank.yaml", "wet-pit.yaml"})
    EXPECT_TRUE(said_of(scene).empty()) << scene << ": " << said_of(scene).front();
}

TEST(Foresight, TellsTheStiffnessThatSoftRocksNeed) {
  EXPECT_TRUE(says(said_of("pit.yaml", {"rocks.stiffness_per_size=1e4 N/m2"}),
                   {"stops the run", "'stiffness_per_size'"}));
}

TEST(Foresight, TellsWhatStiffRocksCost) {
  EXPECT_TRUE(says(said_of("pit.yaml", {"rocks.stiffness_per_size=1e10 N/m2"}), {"times shorter"}));
}

TEST(Foresight, TellsThatRocksStartTooFast) {
  EXPECT_TRUE(says(said_of("pit.yaml", {"rock_fills.stones.velocity=[0 m/s, 0 m/s, -30 m/s]"}),
                   {"land at 30", "'impact_speed'"}));
}

TEST(Foresight, TellsThatAChannelIsSlowerThanItsWavesOrThinnerThanACell) {
  const std::string launder = "../../../processes/launder/rapid.yaml";
  EXPECT_TRUE(said_of(launder).empty()) << said_of(launder).front();
  EXPECT_TRUE(
      says(said_of(launder, {"channels.inlet.flow=10 m3/h"}), {"slower than its waves", "0.347", "0.623"}));
  EXPECT_TRUE(says(said_of(launder, {"water.spacing=50 mm"}), {"200 x 40 mm", "thinner than a cell"}));
}

TEST(Foresight, TellsThatSoundIsTooSlow) {
  EXPECT_TRUE(says(said_of("tank.yaml", {"water.sound_speed=5 m/s"}), {"'sound_speed' to 20"}));
}

TEST(Foresight, TellsThatViscosityRulesTheStep) {
  EXPECT_TRUE(
      says(said_of("tank.yaml", {"water.fluid.viscosity=1000 Pa s"}), {"viscosity", "times shorter"}));
}

TEST(Foresight, TellsThatAYieldStressNeedsWallsThatHold) {
  const std::vector<std::string> mud{"water.fluid.rheology=bingham", "water.fluid.yield_stress=20 Pa"};
  EXPECT_TRUE(says(said_of("tank.yaml", mud), {"yield stress", "'wall_slip: no_slip'"}));
  std::vector<std::string> held = mud;
  held.push_back("water.wall_slip=no_slip");
  EXPECT_TRUE(said_of("tank.yaml", held).empty());
  held.push_back("water.fluid.yield_rate=1e-4 1/s");
  EXPECT_TRUE(says(said_of("tank.yaml", held), {"at rest", "'yield_rate'"}));
}

TEST(Foresight, TellsThatATankIsTooFewCellsWide) {
  EXPECT_TRUE(
      says(said_of("tank.yaml", {"water.spacing=50 mm"}), {"cells wide along y", "'spacing' to 25 mm"}));
}

TEST(Foresight, TellsTheRatioOfSizes) {
  EXPECT_TRUE(says(said_of("mixed-pit.yaml", {"rock_fills.small.sizes.size=2 mm"}), {"a ratio of 50"}));
}

TEST(Foresight, TellsThatLightRocksLackAddedMass) {
  EXPECT_TRUE(says(said_of("wet-pit.yaml", {"materials.rock.density=50 kg/m3"}), {"no added mass"}));
}

}  // namespace
}  // namespace sluice
