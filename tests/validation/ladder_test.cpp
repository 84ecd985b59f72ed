#include "validation/ladder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/errors.h"
#include "validation/temporary_case.h"

namespace sluice {
namespace {

Case committed(const char* name) {
  return read_case(std::filesystem::path(SLUICE_ROOT) / "validation" / name);
}

TEST(ObservedOrder, IsThatOfTheErrorsOverSteps) {
  const std::vector<double> steps{10, 30, 90};
  std::vector<double> errors;
  for (const double n : steps) errors.push_back(3 * std::pow(n, -2));
  EXPECT_NEAR(*observed_order(steps, errors), 2, 1e-12);
}

TEST(ObservedOrder, IsThatOfTheErrorsOverSpacing) {
  EXPECT_NEAR(*observed_order({0.04, 0.02, 0.01}, {0.4, 0.2, 0.1}), 1, 1e-12);
  EXPECT_LT(*observed_order({0.04, 0.02, 0.01}, {0.1, 0.2, 0.4}), 0);
}

TEST(ObservedOrder, NeedsTwoErrorsAboveZero) {
  EXPECT_FALSE(observed_order({1, 2, 4}, {0, 0, 0.1}));
  EXPECT_FALSE(observed_order({1, 2}, {std::nan(""), 0.1}));
}

TEST(ErrorNorm, IsWhatItsWordsSay) {
  const std::vector<Compared> values{{"a", 1.1, 1, 1}, {"b", 1.6, 2, 2}};
  EXPECT_NEAR(error_of(values, ErrorNorm::largest), 0.2, 1e-12);
  EXPECT_NEAR(error_of(values, ErrorNorm::rms), std::sqrt((0.01 + 0.04) / 2), 1e-12);
  EXPECT_NEAR(error_of(values, ErrorNorm::relative_l2), std::sqrt((0.01 + 0.16) / 5), 1e-12);
  EXPECT_TRUE(std::isnan(error_of({{"a", std::nan(""), 1, 1}}, ErrorNorm::largest)));
  EXPECT_TRUE(std::isnan(error_of({}, ErrorNorm::rms)));
}

TEST(Ladder, RecordsEveryRungWithItsCommand) {
  const TemporaryCase folder(sample_case("gate: 0.007", "gate: 0.02"),
                             "restitution,phase\n0.7,2.91842801622\n");
  const ValidationCase c = run_ladder(read_case(folder.path()), {});
  ASSERT_EQ(c.rungs.size(), 3u);
  EXPECT_TRUE(c.passed());
  EXPECT_TRUE(c.whole());
  EXPECT_GT(*c.order, 0.9);
  for (const ValidationRung& r : c.rungs) {
    EXPECT_TRUE(r.stable);
    EXPECT_GT(r.particle_steps, 0);
    EXPECT_EQ(r.command, "sluice validate " + c.name + " --rung '" + r.setting + "'");
  }
}

TEST(Ladder, ReportsAGateThatFails) {
  const TemporaryCase folder(sample_case("gate: 0.02", "gate: 1e-9"),
                             "restitution,phase\n0.7,2.91842801622\n");
  const Case sample = read_case(folder.path());
  const ValidationCase c = run_ladder(sample, {});
  EXPECT_FALSE(c.passed());
  EXPECT_TRUE(c.rungs[0].passed());
  EXPECT_FALSE(c.rungs[1].passed());
  LadderOptions first;
  first.extent = LadderExtent::quick;
  EXPECT_TRUE(run_ladder(sample, first).passed());
}

TEST(Ladder, ReportsAnOrderThatIsTooLow) {
  const TemporaryCase folder(sample_case("least_order: 0.9", "least_order: 3"),
                             "restitution,phase\n0.9,3.07485445788\n");
  const ValidationCase c = run_ladder(read_case(folder.path()), {});
  for (const ValidationRung& r : c.rungs) EXPECT_TRUE(r.passed()) << r.setting << ": " << r.error;
  EXPECT_FALSE(c.passed());
}

TEST(Ladder, KnowsItsRungsByName) {
  LadderOptions options;
  options.only = "20";
  const Case sample = committed("restitution");
  EXPECT_EQ(run_ladder(sample, options).rungs.size(), 1u);
  options.only = "21";
  EXPECT_THROW(run_ladder(sample, options), InputError);
}

TEST(Ladder, CallsARungUnstableThatDoesNotRunToItsEnd) {
  // A hopper as shallow as this one runs empty.
  LadderOptions options;
  options.only = "6";
  options.scene_keys = {"bed_openings=0.3", "seconds=0.05 s"};
  const ValidationCase c = run_ladder(committed("hopper"), options);
  EXPECT_FALSE(c.rungs[0].stable);
  EXPECT_NE(c.rungs[0].message.find("bed_openings"), std::string::npos);
  EXPECT_FALSE(c.passed());
}

/// Error of a case's first rung, scene keys as given.
ValidationRung first_rung(const char* name, const std::vector<std::string>& scene_keys) {
  const Case c = committed(name);
  LadderOptions options;
  options.only = c.config.ladder.rungs[0].at;
  options.scene_keys = scene_keys;
  return run_ladder(c, options).rungs[0];
}

TEST(BrokenConstant, DampingOfRestitutionMissesItsGate) {
  EXPECT_TRUE(first_rung("restitution", {}).passed());
  EXPECT_FALSE(first_rung("restitution", {"damping_factor=0.8"}).passed());
  EXPECT_FALSE(first_rung("restitution", {"damping_factor=1.25"}).passed());
}

TEST(BrokenConstant, DragLawMissesItsGate) {
  EXPECT_TRUE(first_rung("settling-one-way", {}).passed());
  EXPECT_FALSE(first_rung("settling-one-way", {"drag=di_felice"}).passed());
}

TEST(BrokenConstant, EquationOfStateMissesItsGate) {
  EXPECT_TRUE(first_rung("still-column", {"seconds=2 s"}).passed());
  EXPECT_FALSE(first_rung("still-column", {"seconds=2 s", "sound_factor=0.3"}).passed());
}

}  // namespace
}  // namespace sluice
