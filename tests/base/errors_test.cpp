#include "base/errors.h"

#include <gtest/gtest.h>

namespace sluice {
namespace {

InputProblem problem(Location where, std::string key, std::string what) {
  InputProblem p;
  p.where = std::move(where);
  p.key = std::move(key);
  p.problem = std::move(what);
  return p;
}

TEST(InputError, ReadsAsPlaceKeyProblemReasonSuggestion) {
  InputProblem p = problem({"feedbox.yaml", 12, 9}, "bore", "has unit 'kg'");
  p.reason = "a length is needed";
  p.suggestion = "use m, mm or in";
  EXPECT_EQ(p.text(), "feedbox.yaml:12:9: 'bore' has unit 'kg' (a length is needed) use m, mm or in");
}

TEST(InputError, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(problem({"plate.stl", 0, 0}, "", "is empty").text(), "plate.stl: is empty");
  EXPECT_EQ(problem({}, "rate", "is missing").text(), "'rate' is missing");
}

TEST(InputError, HoldsAllProblemsALineEach) {
  const InputError e({problem({"a", 1, 2}, "x", "is bad"), problem({"a", 3, 4}, "y", "is worse")});
  EXPECT_STREQ(e.what(), "a:1:2: 'x' is bad\na:3:4: 'y' is worse");
  EXPECT_EQ(e.problems().size(), 2u);
}

TEST(NumericalError, NamesStageTimeProblemAndRemedy) {
  const NumericalError e("rocks.substeps", 1.3204, "rock 5121 overlap is 0.31 radius (limit 0.05)",
                         "raise 'stiffness'");
  EXPECT_STREQ(e.what(),
               "rocks.substeps t=1.3204 s: rock 5121 overlap is 0.31 radius (limit 0.05); raise 'stiffness'");
  EXPECT_EQ(e.stage(), "rocks.substeps");
  EXPECT_EQ(e.time(), 1.3204);
}

}  // namespace
}  // namespace sluice
