/// What is wrong in a study file is told before anything runs, at its place.

#include <gtest/gtest.h>

#include <fstream>

#include "base/errors.h"
#include "output/temporary_folder.h"
#include "processes/study_config.h"

namespace sluice {
namespace {

std::string problems_of(const std::string& keys) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "study.yaml";
  std::ofstream(file) << "title: T\nprocess: " << SLUICE_ROOT << "/processes/container/water.yaml\n" << keys;
  try {
    read_study(file);
  } catch (const InputError& error) {
    std::string text = error.what();
    for (std::size_t at; (at = text.find(file.string())) != std::string::npos;)
      text.replace(at, file.string().size(), "s.yaml");
    return text;
  }
  return "";
}

const std::string two = "variations: {a: {}, b: {set: [water.spacing=30 mm]}}\n";

TEST(StudyInput, TakesWhatIsRight) {
  EXPECT_EQ(problems_of(two + "seeds: [1, 2]\nuntil: 1 s\n"), "");
}

TEST(StudyInput, SuggestsTheKeyThatWasMeant) {
  EXPECT_EQ(problems_of(two + "seds: [1]\n"),
            "s.yaml:4:1: 'seds' is not a key (of this file) did you mean 'seeds'?");
}

TEST(StudyInput, WantsTwoVariationsAtLeast) {
  EXPECT_NE(problems_of("variations: {a: {}}\n").find("s.yaml:3:1: 'variations' has 1 entry"),
            std::string::npos);
}

TEST(StudyInput, WantsSeedsThatAreWholeAndEachOnce) {
  EXPECT_NE(problems_of(two + "seeds: [-1]\n").find("s.yaml:4:9: 'seeds' is '-1' (out of range)"),
            std::string::npos);
  EXPECT_NE(problems_of(two + "seeds: [1.5]\n").find("'seeds' has 1.5 (whole numbers"), std::string::npos);
  EXPECT_NE(problems_of(two + "seeds: [1, 1]\n").find("'seeds' has 1 (whole numbers"), std::string::npos);
  EXPECT_NE(problems_of(two + "seeds: [1e30]\n").find("'seeds' is '1e30' (out of range)"), std::string::npos);
  EXPECT_NE(problems_of(two + "seeds: []\n").find("'seeds' is empty"), std::string::npos);
}

TEST(StudyInput, PlacesATimeThatIsNone) {
  EXPECT_EQ(problems_of(two + "until: 6 kg\n"),
            "s.yaml:4:1: 'until' is '6 kg' (a time above zero is needed) write 6 s");
  EXPECT_NE(problems_of(two + "until: -6 s\n").find("s.yaml:4:1: 'until' is '-6 s'"), std::string::npos);
}

TEST(StudyInput, KnowsTheVariationsThatAClaimNames) {
  EXPECT_NE(problems_of(two + "claims: {c: {text: x, result: r, kind: lower, of: aa, against: b}}\n")
                .find("'of' is 'aa' (not one of 'variations') did you mean 'a'?"),
            std::string::npos);
  EXPECT_NE(problems_of(two + "claims: {c: {text: x, result: r, kind: lower, of: b, against: b}}\n")
                .find("'against' is the same variation"),
            std::string::npos);
}

TEST(StudyInput, AllowsAMarginOnlyWhereOneIsUsed) {
  EXPECT_NE(
      problems_of(two + "claims: {c: {text: x, result: r, kind: lower, of: a, against: b, margin: 0.1}}\n")
          .find("'margin' does not apply here"),
      std::string::npos);
}

}  // namespace
}  // namespace sluice
