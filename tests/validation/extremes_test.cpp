#include "validation/extremes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "processes/process_config.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

const fs::path root = fs::path(SLUICE_ROOT) / "validation" / "extremes";

std::vector<std::string> settings_at(const ExtremeConfig& config, const ExtremeSetting& rung) {
  std::vector<std::string> all = config.set;
  for (const std::string& key : config.vary)
    if (key != step_over_limit) all.push_back(key + "=" + rung.at);
  all.insert(all.end(), rung.with.begin(), rung.with.end());
  return all;
}

TEST(EveryExtreme, IsReadAndSoIsItsSceneOnEveryRung) {
  const std::vector<fs::path> files = extreme_files(root);
  EXPECT_GE(files.size(), 30u);
  for (const fs::path& file : files) {
    const Extreme extreme = read_extreme(file);
    for (const ExtremeSetting& rung : extreme.config.over) {
      if (rung.expect == ExtremeOutcome::refused) continue;
      EXPECT_NO_THROW(read_process(extreme.config.scene, settings_at(extreme.config, rung)))
          << extreme.name << " at " << rung.at;
    }
  }
}

TEST(EveryExtreme, HasTheRemedyOfItsStopsRead) {
  for (const fs::path& file : extreme_files(root)) {
    const Extreme extreme = read_extreme(file);
    std::vector<std::string> settings = extreme.config.set;
    settings.insert(settings.end(), extreme.config.remedy.begin(), extreme.config.remedy.end());
    EXPECT_NO_THROW(read_process(extreme.config.scene, settings)) << extreme.name;
  }
}

TEST(Watch, StopsABedThatGainsEnergyWithStageTimeRockAndRemedy) {
  const ExtremeRung rung = run_hard({root / "scenes" / "pit.yaml", {}, 1.5});
  EXPECT_EQ(rung.outcome, ExtremeOutcome::stops);
  EXPECT_NE(rung.message.find("rocks.substeps t="), std::string::npos) << rung.message;
  EXPECT_NE(rung.message.find("rock "), std::string::npos) << rung.message;
  EXPECT_NE(rung.message.find("'steps_per_contact'"), std::string::npos) << rung.message;
}

TEST(Watch, LetsABedAtItsOwnStepRun) {
  const ExtremeRung rung = run_hard({root / "scenes" / "pit.yaml", {}, std::nullopt});
  EXPECT_EQ(rung.outcome, ExtremeOutcome::runs) << rung.message;
  EXPECT_LT(std::abs(rung.created), 5);
}

TEST(Watch, StopsWaterWhoseStepIsTooLong) {
  const ExtremeRung rung = run_hard({root / "scenes" / "tank.yaml", {}, 1.5});
  EXPECT_EQ(rung.outcome, ExtremeOutcome::stops);
  EXPECT_NE(rung.message.find("water.grid_to_points t="), std::string::npos) << rung.message;
  EXPECT_NE(rung.message.find("'courant'"), std::string::npos) << rung.message;
}

TEST(Watch, StopsWaterFasterThanAThirdOfTheSpeedOfSound) {
  const ExtremeRung rung =
      run_hard({root / "scenes" / "tank.yaml", {"water.sound_speed=5 m/s"}, std::nullopt});
  EXPECT_EQ(rung.outcome, ExtremeOutcome::stops);
  EXPECT_NE(rung.message.find("'sound_speed'"), std::string::npos) << rung.message;
}

TEST(Watch, StopsRocksThatOverlapBeyondTheLimit) {
  const ExtremeRung rung =
      run_hard({root / "scenes" / "pit.yaml", {"rocks.stiffness_per_size=1e4 N/m2"}, std::nullopt});
  EXPECT_EQ(rung.outcome, ExtremeOutcome::stops);
  EXPECT_NE(rung.message.find("overlap"), std::string::npos) << rung.message;
  EXPECT_NE(rung.message.find("'stiffness"), std::string::npos) << rung.message;
}

TEST(ExtremeRun, IsRefusedWhereNothingIsThere) {
  EXPECT_EQ(run_hard({root / "scenes" / "one-rock.yaml", {"rock_fills={}"}, std::nullopt}).outcome,
            ExtremeOutcome::refused);
}

/// A ladder from 1 on, with what came of each rung.
ExtremeCase ladder(const std::vector<ExtremeOutcome>& outcomes, double standard) {
  ExtremeCase c;
  c.default_number = standard;
  c.default_words = "d";
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    ExtremeRung rung;
    rung.number = static_cast<double>(i + 1);
    rung.expected = rung.outcome = outcomes[i];
    c.rungs.push_back(rung);
  }
  return c;
}

TEST(Frontier, IsTheLastRungBeforeTheFirstThatDoesNotRun) {
  using enum ExtremeOutcome;
  const ExtremeCase c = ladder({runs, runs, stops, runs}, 0.5);
  ASSERT_NE(c.frontier(), nullptr);
  EXPECT_EQ(c.frontier()->number, 2);
  EXPECT_EQ(c.beyond()->number, 3);
  EXPECT_NE(c.margin().find("a factor of 4"), std::string::npos) << c.margin();
  EXPECT_EQ(ladder({stops, stops}, 1).frontier(), nullptr);
  EXPECT_NE(ladder({runs, stops}, 2).margin().find("BEYOND"), std::string::npos);
}

TEST(Rung, IsNotGoodWhereItBreaksOrItsRemedyDoesNotHelp) {
  ExtremeRung rung;
  rung.expected = rung.outcome = ExtremeOutcome::stops;
  EXPECT_TRUE(rung.good());
  rung.remedy_works = false;
  EXPECT_FALSE(rung.good());
  rung.remedy_works = true;
  rung.outcome = rung.expected = ExtremeOutcome::broken;
  EXPECT_FALSE(rung.good());
}

}  // namespace
}  // namespace sluice
