/// Every file under processes/ loads, and scenes hold only what they need.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/memory_archive.h"
#include "base/parallel.h"
#include "processes/build_parts.h"
#include "processes/study_config.h"
#include "simulation/simulation.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

const fs::path processes = fs::path(SLUICE_ROOT) / "processes";

std::vector<fs::path> all_process_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(processes))
    if (entry.path().extension() == ".yaml" && entry.path().parent_path().filename() != "studies")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> all_study_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(processes))
    if (entry.path().extension() == ".yaml" && entry.path().parent_path().filename() == "studies")
      files.push_back(entry.path());
  return files;
}

Simulation simulation_of(const std::string& file, const std::vector<std::string>& overrides = {}) {
  return Simulation(std::move(build_parts(read_process(processes / file, overrides)).parts));
}

std::vector<std::string> stage_names(const Simulation& simulation) {
  std::vector<std::string> names;
  for (const Stage& stage : simulation.stages()) names.push_back(stage.name);
  return names;
}

TEST(ProcessFiles, AllLoadAndFitTogether) {
  const std::vector<fs::path> files = all_process_files();
  ASSERT_GE(files.size(), 9u);
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    EXPECT_NO_THROW({
      const ProcessConfig config = read_process(file, {});
      const Simulation simulation(std::move(build_parts(config).parts));
      EXPECT_FALSE(config.title.empty());
      EXPECT_GT(simulation.time_step().dt, 0.0);
    });
  }
}

TEST(StudyFiles, AllLoadAndEveryVariationFitsTogether) {
  const std::vector<fs::path> files = all_study_files();
  ASSERT_GE(files.size(), 2u);
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    EXPECT_NO_THROW({
      const StudyConfig study = read_study(file);
      for (const VariationConfig& variation : study.variations) {
        std::vector<std::string> set = study.set;
        set.insert(set.end(), variation.set.begin(), variation.set.end());
        build_parts(read_process(study.process_of(variation), set));
      }
    });
  }
}

TEST(DryScene, HasNoFluidStageAndNoFluidMemory) {
  const Simulation dry = simulation_of("transfer-chute/dry.yaml");
  EXPECT_EQ(stage_names(dry), (std::vector<std::string>{"inflow", "rocks.substeps", "exits"}));
  EXPECT_EQ(dry.parts().water, nullptr);
  EXPECT_EQ(dry.parts().coupling, nullptr);
}

TEST(WaterScene, HasNoRockStageAndNoRockMemory) {
  const Simulation wet = simulation_of("container/water.yaml");
  EXPECT_EQ(stage_names(wet), (std::vector<std::string>{"water.points_to_grid", "water.walls",
                                                        "water.grid_to_points", "exits", "probes"}));
  EXPECT_EQ(wet.parts().rocks, nullptr);
  EXPECT_EQ(wet.parts().coupling, nullptr);
}

TEST(FeedBox, StepsInTheOrderOfSinnottAndCleary) {
  const Simulation box = simulation_of("feedbox/demo.yaml");
  EXPECT_EQ(stage_names(box),
            (std::vector<std::string>{"inflow", "coupling.solids_to_grid", "water.points_to_grid",
                                      "coupling.drag", "water.walls", "water.grid_to_points",
                                      "coupling.fluid_to_grid", "rocks.substeps", "exits", "probes"}));
}

std::uint64_t hash_after(const std::string& file, int steps, int threads) {
  const int before = thread_count();
  set_thread_count(threads);
  Simulation simulation = simulation_of(file);
  for (int i = 0; i < steps; ++i) simulation.step();
  set_thread_count(before);
  return simulation.state_hash();
}

TEST(StateHash, IsTheSameForAnyNumberOfThreads) {
  for (const auto& [file, steps] :
       {std::pair{"container/mixed.yaml", 100}, {"transfer-chute/dry.yaml", 60}}) {
    SCOPED_TRACE(file);
    const std::uint64_t one = hash_after(file, steps, 1);
    EXPECT_NE(one, 0u);
    EXPECT_EQ(hash_after(file, steps, 2), one);
    EXPECT_EQ(hash_after(file, steps, 3), one);
  }
}

TEST(StateHash, IsTheSameAfterARestart) {
  for (const auto& [file, steps] :
       {std::pair{"container/mixed.yaml", 100}, {"transfer-chute/dry.yaml", 80}}) {
    SCOPED_TRACE(file);
    Simulation whole = simulation_of(file);
    MemoryArchive saved;
    for (int i = 0; i < steps; ++i) {
      if (i == steps / 2) whole.exchange(saved);
      whole.step();
    }
    Simulation second = simulation_of(file);
    saved.rewind_to_load();
    second.exchange(saved);
    EXPECT_EQ(second.steps(), static_cast<std::uint64_t>(steps / 2));
    for (int i = steps / 2; i < steps; ++i) second.step();
    EXPECT_EQ(second.state_hash(), whole.state_hash());
  }
}

}  // namespace
}  // namespace sluice
