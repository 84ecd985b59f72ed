#include "app/run_series.h"

#include <gtest/gtest.h>

#include "app/process_source.h"
#include "base/errors.h"
#include "output/run_folder.h"
#include "output/run_manifest.h"
#include "output/temporary_folder.h"
#include "sluice_version.h"

namespace sluice {
namespace {

PlannedRun planned(const TemporaryFolder& temporary, const std::string& setting) {
  PlannedRun run;
  run.name = "water.spacing = " + setting;
  run.place = {"--over", 0, 0};
  run.options.process = std::string(SLUICE_ROOT) + "/processes/container/water.yaml";
  run.options.out = temporary.path / folder_name(setting);
  run.options.overrides = {"water.spacing=" + setting};
  return run;
}

/// What a run leaves behind, without running it.
void leave(const PlannedRun& run, Outcome outcome, double simulated,
           const std::string& commit = program_commit) {
  open_run_folder(run.options.out, FolderUse::resume);
  RunManifest m;
  m.outcome = outcome;
  m.sluice.commit = commit;
  m.process.sha256 = read_process_source(run.options.process, run.options.overrides).sha256;
  m.time.simulated_s = simulated;
  m.time.dt_fluid_s = 1e-3;
  write_manifest(RunFolder{run.options.out}.manifest(), m);
}

TEST(FolderName, SaysTheSetting) {
  EXPECT_EQ(folder_name("20 mm"), "20-mm");
  EXPECT_EQ(folder_name("[1, 2 m]"), "1-2-m");
  EXPECT_EQ(folder_name(".."), "setting");
}

TEST(CommandOf, MakesTheRunAlone) {
  RunOptions options;
  options.process = "a.yaml";
  options.out = "out/x";
  options.until = "2 s";
  options.whole = true;
  options.overrides = {"water.spacing=20 mm"};
  EXPECT_EQ(command_of(options),
            "sluice run a.yaml --set 'water.spacing=20 mm' --until '2 s' --no-stop --out out/x");
}

TEST(Series, RunsWhatIsNotFinishedOnly) {
  const TemporaryFolder temporary;
  const std::vector<PlannedRun> runs = {planned(temporary, "40 mm"), planned(temporary, "20 mm")};
  leave(runs[0], Outcome::completed, 2);
  std::vector<std::string> run;
  EXPECT_EQ(run_series(runs,
                       [&](const RunOptions& o) {
                         run.push_back(o.out.filename().string());
                         EXPECT_FALSE(o.resume);
                         return 0;
                       }),
            0);
  EXPECT_EQ(run, std::vector<std::string>{"20-mm"});
}

TEST(Series, GoesOnWithALaterEnd) {
  const TemporaryFolder temporary;
  PlannedRun run = planned(temporary, "40 mm");
  leave(run, Outcome::completed, 2);
  EXPECT_EQ(standing_of(run), Standing::finished);
  run.options.until = "3 s";
  // There is no checkpoint here to go on from.
  EXPECT_EQ(standing_of(run), Standing::fresh);
  run.options.until = "1 s";
  EXPECT_EQ(standing_of(run), Standing::finished);
}

TEST(Series, KeepsAFailureAsARowAndRunsTheOthers) {
  const TemporaryFolder temporary;
  const std::vector<PlannedRun> runs = {planned(temporary, "40 mm"), planned(temporary, "20 mm")};
  int count = 0;
  EXPECT_EQ(run_series(runs, [&](const RunOptions&) { return ++count == 1 ? 3 : 0; }), 3);
  EXPECT_EQ(count, 2);
}

TEST(Series, DoesNotRepeatAFailureOfTheSameProgram) {
  const TemporaryFolder temporary;
  const PlannedRun run = planned(temporary, "40 mm");
  leave(run, Outcome::failed, 0.5);
  EXPECT_EQ(run_series({run}, [](const RunOptions&) { return 0; }), 3);
  leave(run, Outcome::failed, 0.5, "another");
  EXPECT_EQ(run_series({run}, [](const RunOptions&) { return 0; }), 0);
}

TEST(Series, StopsWhereItIsInterrupted) {
  const TemporaryFolder temporary;
  int count = 0;
  EXPECT_EQ(run_series({planned(temporary, "40 mm"), planned(temporary, "20 mm")},
                       [&](const RunOptions&) {
                         ++count;
                         return 130;
                       }),
            130);
  EXPECT_EQ(count, 1);
}

TEST(Series, StopsWhereTheMachineFails) {
  const TemporaryFolder temporary;
  EXPECT_THROW(run_series({planned(temporary, "40 mm")}, [](const RunOptions&) { return 4; }),
               EnvironmentError);
}

TEST(Series, RefusesAFolderWithAnotherRun) {
  const TemporaryFolder temporary;
  PlannedRun run = planned(temporary, "40 mm");
  leave(run, Outcome::completed, 2);
  run.options.overrides.push_back("duration=3 s");
  EXPECT_THROW(standing_of(run), InputError);
}

TEST(Series, PlacesWhatIsWrongWithASettingWhereItIsMade) {
  const TemporaryFolder temporary;
  PlannedRun run = planned(temporary, "40 mm");
  run.options.overrides = {"water.spacing=20 kg"};
  try {
    check_series({run});
    FAIL() << "it was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--over: 'spacing' has unit 'kg'"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace sluice
