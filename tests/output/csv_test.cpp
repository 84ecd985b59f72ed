#include "output/csv.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "output/run_folder.h"
#include "output/temporary_folder.h"

namespace sluice {
namespace {

TEST(Csv, KeepsEveryBitOfANumber) {
  const TemporaryFolder temporary;
  CsvTable table;
  table.columns = {"a", "b"};
  table.add({0.1, 1.0 / 3.0});
  table.add({-1e-300, 6.02214076e23});
  write_csv(temporary.path / "t.csv", table);
  const CsvTable back = read_csv(temporary.path / "t.csv");
  EXPECT_EQ(back.columns, table.columns);
  EXPECT_EQ(back.rows, table.rows);
}

TEST(Csv, QuotesCommasQuotationMarksAndLineEnds) {
  CsvTable table;
  table.columns = {"name", "x_m"};
  table.add({std::string("a, \"b\"\nc"), 2.0});
  EXPECT_EQ(csv_text(table), "name,x_m\n\"a, \"\"b\"\"\nc\",2\n");
  const CsvTable back = parse_csv(csv_text(table), "t.csv");
  EXPECT_EQ(back.texts("name"), std::vector<std::string>{"a, \"b\"\nc"});
  EXPECT_EQ(back.numbers("x_m"), std::vector<double>{2.0});
}

TEST(Csv, WritesNothingForANumberThatIsNone) {
  CsvTable table;
  table.columns = {"a", "b", "c"};
  table.add({std::nan(""), HUGE_VAL, 1.0});
  EXPECT_EQ(csv_text(table), "a,b,c\n,,1\n");
  const std::vector<double> back = parse_csv(csv_text(table), "t.csv").numbers("a");
  ASSERT_EQ(back.size(), 1u);
  EXPECT_TRUE(std::isnan(back[0]));
}

TEST(Csv, ReadsLineEndsOfOtherSystems) {
  const CsvTable table = parse_csv("a,b\r\n1,x\r\n", "t.csv");
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.texts("b"), std::vector<std::string>{"x"});
}

TEST(Csv, HasNoValuesForAColumnThatIsNotThere) {
  const CsvTable table = parse_csv("a\n1\n", "t.csv");
  EXPECT_FALSE(table.find("b"));
  EXPECT_TRUE(table.numbers("b").empty());
}

TEST(Csv, RefusesRowsOfAnotherLengthAndOpenQuotations) {
  EXPECT_THROW(parse_csv("a,b\n1\n", "t.csv"), InputError);
  EXPECT_THROW(parse_csv("a,b\n1,\"x\n", "t.csv"), InputError);
  EXPECT_THROW(parse_csv("", "t.csv"), InputError);
  try {
    parse_csv("a,b\n1,2\n3\n", "t.csv");
    FAIL() << "a short row was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("t.csv:3"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sluice
