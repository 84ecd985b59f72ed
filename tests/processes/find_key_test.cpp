#include "processes/find_key.h"

#include <gtest/gtest.h>

#include "processes/process_config.h"

namespace sluice {
namespace {

const std::string processes = std::string(SLUICE_ROOT) + "/processes/";

std::string problem_with(const std::string& scene, const std::string& path) {
  const auto problems = misnamed_key(ProcessDocument::read(processes + scene), process_keys<ProcessConfig>(),
                                     path, {"--vary", 0, 0});
  return problems.empty() ? "" : problems.front().text();
}

TEST(FindKey, FindsKeysUnderNamesAndInLists) {
  const auto keys = process_keys<ProcessConfig>();
  ASSERT_NE(find_key(keys, "water.spacing"), nullptr);
  EXPECT_EQ(find_key(keys, "water.spacing")->unit, "m");
  ASSERT_NE(find_key(keys, "pipes.header_pipes.bore"), nullptr);
  ASSERT_NE(find_key(keys, "contacts.0.friction"), nullptr);
  EXPECT_EQ(find_key(keys, "water.spacin"), nullptr);
}

TEST(MisnamedKey, HasNothingAgainstKeysOfTheScene) {
  for (const char* path :
       {"water.spacing", "rocks.steps_per_contact", "conveyors.feed.rate", "contacts.0.friction",
        "coupling.kernel_diameters", "water.fluid.viscosity", "seed"})
    EXPECT_EQ(problem_with("feedbox/pipes-1200tph.yaml", path), "") << path;
}

TEST(MisnamedKey, SuggestsTheNearestKeyOrName) {
  EXPECT_NE(problem_with("feedbox/box.yaml", "water.spacin").find("did you mean 'spacing'?"),
            std::string::npos);
  EXPECT_NE(problem_with("feedbox/box.yaml", "watr.spacing").find("did you mean 'water'?"),
            std::string::npos);
  EXPECT_NE(problem_with("feedbox/box.yaml", "conveyors.fed.rate").find("did you mean 'feed'?"),
            std::string::npos);
}

TEST(MisnamedKey, RefusesASectionThatTheSceneLacks) {
  EXPECT_NE(problem_with("transfer-chute/dry.yaml", "water.spacing").find("is not in this scene"),
            std::string::npos);
  EXPECT_NE(problem_with("feedbox/box.yaml", "water").find("is a section"), std::string::npos);
  EXPECT_NE(problem_with("feedbox/box.yaml", "contacts.9.friction").find("3 items"), std::string::npos);
}

}  // namespace
}  // namespace sluice
