#include "validation/case.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/errors.h"
#include "validation/ladder.h"
#include "validation/temporary_case.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

const fs::path all_cases = fs::path(SLUICE_ROOT) / "validation";

TEST(EveryCase, IsReadAndHasItsPage) {
  const std::vector<fs::path> folders = case_folders(all_cases);
  EXPECT_GE(folders.size(), 25u);
  for (const fs::path& folder : folders) {
    const Case c = read_case(folder);
    EXPECT_GE(c.config.ladder.rungs.size(), 3u) << c.name;
    EXPECT_TRUE(fs::exists(folder / "README.md")) << c.name;
    EXPECT_FALSE(read_csv(c.config.reference.table).rows.empty()) << c.name;
  }
}

TEST(EveryMeasure, HasACase) {
  std::string used;
  for (const fs::path& folder : case_folders(all_cases)) used += read_case(folder).config.measure + " ";
  for (const MeasureKind& kind : measure_kinds())
    EXPECT_NE(used.find(std::string(kind.word) + " "), std::string::npos) << kind.word;
}

/// What reading a case with this text says; "" if nothing.
std::string complaint(const std::string& yaml) {
  const TemporaryCase folder(yaml, "restitution,phase\n0.5,2.7\n");
  try {
    read_case(folder.path());
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(BadCase, IsNotAGoodOne) {
  EXPECT_EQ(complaint(sample_case()), "");
}

TEST(BadCase, IsRefusedWithItsPlace) {
  EXPECT_NE(complaint(sample_case("measure: rock_rebound", "measure: rock_reboundd"))
                .find("case.yaml:3:1: 'measure' is 'rock_reboundd', which is none"),
            std::string::npos)
      << complaint(sample_case("measure: rock_rebound", "measure: rock_reboundd"));
  EXPECT_NE(complaint(sample_case("group: rocks", "group: stones")).find("case.yaml:2:1: 'group'"),
            std::string::npos);
  EXPECT_NE(complaint(sample_case("vary: steps_per_contact", "vary: steps"))
                .find("case.yaml:5:3: 'steps' is not a key"),
            std::string::npos)
      << complaint(sample_case("vary: steps_per_contact", "vary: steps"));
}

TEST(BadCase, NeedsThreeRungsInOrderInOneUnitWithAGate) {
  EXPECT_NE(complaint(sample_case("{at: 50, gate: 0.007}", "{at: 15, gate: 0.007}")).find("turns round"),
            std::string::npos);
  EXPECT_NE(complaint(sample_case(", {at: 50, gate: 0.007}", "")).find("has 2 rungs"), std::string::npos);
  EXPECT_NE(complaint(sample_case("{at: 50, gate: 0.007}", "{at: 50 mm}")).find("mixes"), std::string::npos);
  EXPECT_NE(complaint(sample_case("[{at: 8, gate: 0.06}, {at: 20, gate: 0.02}, {at: 50, gate: 0.007}]\n"
                                  "  least_order: 0.9",
                                  "[{at: 8}, {at: 20}, {at: 50}]"))
                .find("has no gate"),
            std::string::npos);
}

TEST(BadCase, NamesATableThatIsNotThere) {
  EXPECT_NE(complaint(sample_case("reference.csv", "refrence.csv")).find("did you mean 'reference.csv'?"),
            std::string::npos);
}

TEST(CaseFolders, SayWhereTheyLooked) {
  EXPECT_THROW(case_folders("no/such/folder"), EnvironmentError);
}

}  // namespace
}  // namespace sluice
