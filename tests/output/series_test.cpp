#include "output/series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/errors.h"
#include "output/run_folder.h"
#include "output/temporary_folder.h"

namespace sluice {
namespace {

const std::vector<std::string> columns = {"time_s", "rock_in_kg_s"};

TEST(Series, IsOnDiskAfterEveryRow) {
  const TemporaryFolder temporary;
  SeriesWriter series(temporary.path / "series.csv", columns, std::nullopt);
  EXPECT_EQ(read_whole_file(temporary.path / "series.csv"), "time_s,rock_in_kg_s\n");
  series.append({0.1, 333});
  EXPECT_EQ(read_whole_file(temporary.path / "series.csv"), "time_s,rock_in_kg_s\n0.1,333\n");
  series.append({0.2, std::nan("")});
  EXPECT_EQ(read_whole_file(temporary.path / "series.csv"), "time_s,rock_in_kg_s\n0.1,333\n0.2,\n");
}

TEST(Series, IsTheSameAfterAResumeAsWithoutAStop) {
  const TemporaryFolder temporary;
  const auto one = temporary.path / "one.csv", two = temporary.path / "two.csv";
  {
    SeriesWriter series(one, columns, std::nullopt);
    for (int k = 1; k <= 9; ++k) series.append({0.1 * k, std::sqrt(k)});
  }
  {
    SeriesWriter series(two, columns, std::nullopt);
    for (int k = 1; k <= 7; ++k) series.append({0.1 * k, std::sqrt(k)});
  }
  // the last checkpoint was at 0.5 s; the process was killed while it wrote a row
  std::ofstream(two, std::ios::app) << "0.8,2.8";
  {
    SeriesWriter series(two, columns, 0.1 * 5);
    for (int k = 6; k <= 9; ++k) series.append({0.1 * k, std::sqrt(k)});
  }
  EXPECT_EQ(read_whole_file(one), read_whole_file(two));
}

TEST(Series, RefusesToGoOnWithOtherColumns) {
  const TemporaryFolder temporary;
  { SeriesWriter series(temporary.path / "s.csv", columns, std::nullopt); }
  EXPECT_THROW(SeriesWriter(temporary.path / "s.csv", {"time_s", "other"}, 1.0), InputError);
}

TEST(Series, RefusesARowOfAnotherLength) {
  const TemporaryFolder temporary;
  SeriesWriter series(temporary.path / "s.csv", columns, std::nullopt);
  EXPECT_THROW(series.append({1.0}), std::logic_error);
}

TEST(Series, SaysWhyItCannotBeWritten) {
  EXPECT_THROW(SeriesWriter("/nowhere/series.csv", columns, std::nullopt), EnvironmentError);
}

}  // namespace
}  // namespace sluice
