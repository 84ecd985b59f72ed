#include "output/run_series.h"

#include <gtest/gtest.h>

#include <cmath>

#include "output/json_text.h"

namespace sluice {
namespace {

KeyResult result(double value, double half_width, bool steady = true) {
  KeyResult r;
  r.name = "lip.water_cov_across_width";
  r.value = value;
  r.half_width = half_width;
  r.steady = steady;
  return r;
}

SeriesRow row(const std::string& label, double setting, std::vector<KeyResult> results) {
  SeriesRow r;
  r.label = label;
  r.setting = setting;
  r.outcome = "completed";
  r.results = std::move(results);
  return r;
}

ConvergeRecord ladder() {
  ConvergeRecord record;
  record.rungs = {row("40 mm", 0.04, {result(0.30, 0.01)}), row("20 mm", 0.02, {result(0.22, 0.01)}),
                  row("10 mm", 0.01, {result(0.21, 0.005)})};
  return record;
}

TEST(ConvergeRecord, TellsTheChangeFromTheRungBefore) {
  const ConvergeRecord record = ladder();
  const std::string name = "lip.water_cov_across_width";
  EXPECT_FALSE(record.change(0, name));
  EXPECT_NEAR(record.change(1, name)->value, -0.08, 1e-15);
  EXPECT_EQ(record.change(1, name)->verdict, ChangeVerdict::resolved);
  EXPECT_EQ(record.change(2, name)->verdict, ChangeVerdict::bounded);
  const CsvTable table = converge_table(record);
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(table.texts("verdict"), (std::vector<std::string>{"", "resolved", "bounded"}));
  EXPECT_NEAR(table.numbers("low95")[0], 0.29, 1e-15);
}

TEST(ConvergeRecord, MakesNothingOfAverageThatIsNotSteady) {
  ConvergeRecord record = ladder();
  record.rungs[2].results = {result(0.21, 0.005, false)};
  EXPECT_EQ(record.change(2, "lip.water_cov_across_width")->verdict, ChangeVerdict::unknown);
}

TEST(ConvergeRecord, KeepsARungThatFailedAsARow) {
  ConvergeRecord record = ladder();
  record.rungs[2].outcome = "failed";
  record.rungs[2].message = "rock 3 overlaps";
  const CsvTable table = converge_table(record);
  EXPECT_EQ(table.texts("outcome")[2], "failed");
  EXPECT_EQ(table.texts("reason")[2], "rock 3 overlaps");
  EXPECT_TRUE(std::isnan(table.numbers("value")[2]));
  EXPECT_EQ(table.texts("verdict")[2], "unknown");
}

TEST(StudyRecord, TakesItsLimitsFromTheSeeds) {
  StudyRecord record;
  record.variations = {"pipes"};
  for (long seed = 1; seed <= 5; ++seed) {
    // Averages that are not steady on their own are still repetitions of one experiment.
    record.runs.push_back(row("pipes", 0, {result(1.0 + 2.0 * static_cast<double>(seed - 1), 9, false)}));
    record.runs.back().seed = seed;
  }
  const Estimate e = record.estimate("pipes", "lip.water_cov_across_width");
  EXPECT_DOUBLE_EQ(e.value, 5);
  EXPECT_NEAR(e.half_width, 2.776 * std::sqrt(2.0), 0.04);
  const CsvTable table = study_table(record);
  ASSERT_EQ(table.rows.size(), 6u);
  EXPECT_EQ(table.texts("seed")[5], "all");
}

TEST(SeriesRow, OfAFolderWithoutAManifestHasFailed) {
  const SeriesRow missing = read_series_row("/nowhere/at/all");
  EXPECT_EQ(missing.outcome, "failed");
  EXPECT_FALSE(missing.message.empty());
}

TEST(JsonText, EscapesWhatJsonCannotHold) {
  EXPECT_EQ(json_string("a \"b\"\n"), "\"a \\\"b\\\"\\u000a\"");
  EXPECT_EQ(json_number(std::nan("")), "null");
  EXPECT_EQ(json_object({{"a", "1"}, {"b", json_array({"2", "3"})}}), "{\"a\": 1, \"b\": [2, 3]}");
}

}  // namespace
}  // namespace sluice
