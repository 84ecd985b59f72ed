#include "output/run_manifest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "output/run_folder.h"
#include "output/temporary_folder.h"

namespace sluice {
namespace {

using Json = nlohmann::ordered_json;

RunManifest full_manifest() {
  RunManifest m;
  m.sluice = {"0.1.0", "abc123", "g++ 12.2", "-O3"};
  m.process = {"feedbox.yaml", "00ff", "Feed box \"A\""};
  m.machine = {2, "a processor"};
  m.outcome = Outcome::completed;
  m.time.simulated_s = 12.5;
  m.time.wall_s = 300;
  m.time.steps = 1000;
  m.time.dt_fluid_s = 1e-4;
  m.time.dt_rock_s = 2e-5;
  m.time.rock_steps = 5000;
  m.time.fluid_steps = 1000;
  m.parts = {{"rocks", "water"}, {"mixing"}};
  m.counts = {100, 120, 4000, 5000, 64};
  m.budgets.rock = BudgetEntry{0, 100, 99, 1, 50, {{"lip", 48}, {"outside", 1}}, 0};
  m.budgets.water = BudgetEntry{10, 20, 20, 0, 25, {{"lip", 5}, {"outside", 0}}, 0};
  m.budgets.momentum_residual_N_s = {1e-9, -2e-9, 0};
  m.budgets.energy = {{"rock_kinetic_J", 5}};
  m.overlap = RunManifest::Overlap{0.4, 1.5, 3};
  m.resolved = RunManifest::Resolved{0.1, 0.03, 2, 5};
  m.memory = {1000, 600, 300};
  m.stages = {{"rocks.substeps", 12.5, 1000}};
  m.rates = {1e6, 2e5};
  RunManifest::ExitSummary& lip = m.exits.emplace_back();
  lip.name = "lip";
  lip.rock_kg_s = 333;
  lip.rock_cov_across_width = 0.2;
  lip.steady_from_s = 5;
  lip.averages = RunManifest::ExitAverages{
      5, 12, true, "", {{"rock_kg_s", 333, 320, 346}, {"p80_m", 0.08, HUGE_VAL, HUGE_VAL}}};
  m.state_hash = "0123456789abcdef";
  m.warnings = {"one", "two"};
  return m;
}

// The interface that pipelines rely on, key by key.
const std::vector<std::string> promised = {"/sluice/version",
                                           "/sluice/commit",
                                           "/sluice/compiler",
                                           "/sluice/flags",
                                           "/process/file",
                                           "/process/sha256",
                                           "/process/title",
                                           "/machine/threads",
                                           "/machine/cpu",
                                           "/outcome",
                                           "/failure",
                                           "/time/simulated_s",
                                           "/time/wall_s",
                                           "/time/steps",
                                           "/time/dt_fluid_s",
                                           "/time/dt_rock_s",
                                           "/time/rock_steps",
                                           "/time/fluid_steps",
                                           "/parts/present",
                                           "/parts/left_out",
                                           "/counts/rocks",
                                           "/counts/rocks_max",
                                           "/counts/water_points",
                                           "/counts/water_points_max",
                                           "/counts/wall_triangles",
                                           "/budgets/rock",
                                           "/budgets/water",
                                           "/budgets/momentum_residual_N_s",
                                           "/budgets/energy",
                                           "/overlap/mean_percent_of_radius",
                                           "/overlap/p99_percent_of_radius",
                                           "/overlap/max_percent_of_radius",
                                           "/memory/peak_bytes",
                                           "/memory/fluid_bytes",
                                           "/memory/rock_bytes",
                                           "/stages",
                                           "/rates/water_point_steps_per_s",
                                           "/rates/rock_steps_per_s",
                                           "/exits",
                                           "/state_hash",
                                           "/warnings"};
const std::vector<std::string> promised_budget = {"initial_kg", "requested_kg", "entered_kg", "waiting_kg",
                                                  "inside_kg",  "left_kg",      "lost_kg"};
const std::vector<std::string> promised_exit = {
    "rock_kg_s",         "water_kg_s",   "rock_cov_across_width", "water_cov_across_width",
    "water_to_rock_cov", "steady_from_s"};

TEST(RunManifest, HasEveryPromisedKeyWhateverTheScene) {
  for (const RunManifest& m : {full_manifest(), RunManifest{}}) {
    const Json json = Json::parse(manifest_text(m));
    for (const std::string& key : promised) EXPECT_TRUE(json.contains(Json::json_pointer(key))) << key;
  }
  const Json json = Json::parse(manifest_text(full_manifest()));
  for (const std::string& key : promised_budget) {
    EXPECT_TRUE(json["budgets"]["rock"].contains(key)) << key;
    EXPECT_TRUE(json["budgets"]["water"].contains(key)) << key;
  }
  for (const std::string& key : promised_exit) EXPECT_TRUE(json["exits"]["lip"].contains(key)) << key;
  EXPECT_EQ(json["budgets"]["rock"]["left_kg"]["lip"], 48);
  EXPECT_EQ(json["stages"][0]["name"], "rocks.substeps");
  EXPECT_EQ(json["outcome"], "completed");
}

TEST(RunManifest, WritesNullForAnAbsentPart) {
  const Json json = Json::parse(manifest_text(RunManifest{}));
  for (const char* key :
       {"/failure", "/time/dt_fluid_s", "/counts/rocks", "/budgets/water", "/budgets/energy",
        "/budgets/momentum_residual_N_s", "/overlap/max_percent_of_radius", "/rates/water_point_steps_per_s"})
    EXPECT_TRUE(json[Json::json_pointer(key)].is_null()) << key;
}

TEST(RunManifest, WritesNullForANumberThatIsNone) {
  RunManifest m = full_manifest();
  m.time.wall_s = std::nan("");
  m.exits[0].rock_kg_s = HUGE_VAL;
  const Json json = Json::parse(manifest_text(m));
  EXPECT_TRUE(json["time"]["wall_s"].is_null());
  EXPECT_TRUE(json["exits"]["lip"]["rock_kg_s"].is_null());
}

TEST(RunManifest, ReadsBackWhatItWrote) {
  const TemporaryFolder temporary;
  for (RunManifest m : {full_manifest(), RunManifest{}}) {
    write_manifest(temporary.path / "run.json", m);
    EXPECT_EQ(manifest_text(read_manifest(temporary.path / "run.json")), manifest_text(m));
  }
}

TEST(RunManifest, TellsAFailureWithItsStageAndTime) {
  const TemporaryFolder temporary;
  RunManifest m;
  m.outcome = Outcome::failed;
  m.failure = RunManifest::Failure{"water.walls", 1.25, "NaN"};
  write_manifest(temporary.path / "run.json", m);
  const RunManifest back = read_manifest(temporary.path / "run.json");
  ASSERT_TRUE(back.failure);
  EXPECT_EQ(back.outcome, Outcome::failed);
  EXPECT_EQ(back.failure->stage, "water.walls");
  EXPECT_EQ(back.failure->time_s, 1.25);
}

TEST(RunManifest, SurvivesATitleThatIsNotUtf8) {
  RunManifest m;
  m.process.title = "bad \xff byte";
  EXPECT_TRUE(Json::accept(manifest_text(m)));
}

TEST(RunManifest, RefusesWhatIsNoManifest) {
  const TemporaryFolder temporary;
  for (const char* text :
       {"", "[]", "{\"a\": 1}", "{\"sluice\": 3}", "{\"time\": {\"steps\": \"many\"}}", "{"}) {
    write_atomically(temporary.path / "run.json", text);
    EXPECT_THROW(read_manifest(temporary.path / "run.json"), InputError) << text;
  }
  EXPECT_THROW(read_manifest(temporary.path / "none.json"), EnvironmentError);
}

TEST(BudgetEntry, ClosesWhenNothingIsLost) {
  const BudgetEntry budget = *full_manifest().budgets.rock;
  EXPECT_EQ(budget.left_total(), 49);
  EXPECT_EQ(budget.residual(), 0);
}

}  // namespace
}  // namespace sluice
