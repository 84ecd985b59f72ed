#include "reports/chart.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reports/format.h"

namespace sluice {
namespace {

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(RoundTicks, AreFewRoundAndCoverTheRange) {
  for (const auto& [low, high] : std::vector<std::pair<double, double>>{
           {0, 1}, {0, 333}, {-0.03, 0.07}, {1e-6, 2.3e-6}, {0, 12.5}, {5, 5}}) {
    const std::vector<double> ticks = round_ticks(low, high);
    EXPECT_GE(ticks.size(), 2u);
    EXPECT_LE(ticks.size(), 9u);
    EXPECT_LE(ticks.front(), low + 1e-12);
    EXPECT_GE(ticks.back(), high - 1e-12);
  }
}

TEST(LineChart, LeavesAGapWhereAValueIsMissing) {
  const std::string svg = line_chart({"t", "x", "y"}, {{"a", {0, 1, 2, 3}, {1, std::nan(""), 2, 3}, {}, {}}});
  const std::size_t path = svg.find(" d=\"M");
  ASSERT_NE(path, std::string::npos);
  EXPECT_EQ(times(svg.substr(path, svg.find('"', path + 5) - path), "M"), 2u);
}

TEST(LineChart, StandsWithoutAnyValue) {
  const std::string svg = line_chart({"t", "x", "y"}, {{"a", {}, {}, {}, {}}});
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(BinChart, DrawsABarAndAWhiskerPerBin) {
  const std::string svg =
      bin_chart({"t", "x", "y"}, {0, 1, 2, 3}, {{"a", {}, {1, 2, std::nan("")}, {0.5, 1, 1}, {2, 3, 3}}});
  EXPECT_EQ(times(svg, "<title>"), 2u);
  EXPECT_EQ(times(svg, "class=\"whisker\""), 2u);
}

TEST(BinChart, EscapesItsNames) {
  const std::string svg =
      bin_chart({"<t>", "<x>", "<y>"}, {0, 1}, {{"<a>", {}, {1}, {}, {}}, {"<b>", {}, {1}, {}, {}}});
  for (const char* raw : {"<t>", "<x>", "<y>", "<a>", "<b>"})
    EXPECT_EQ(svg.find(raw), std::string::npos) << raw;
}

TEST(Format, WritesNumbersAsPeopleReadThem) {
  EXPECT_EQ(number(0.0), "0");
  EXPECT_EQ(number(3.14159), "3.14");
  EXPECT_EQ(number(1234.5), "1234");
  EXPECT_EQ(number(0.00123), "0.00123");
  EXPECT_EQ(number(1234567.0), "1\u202f234\u202f567");
  EXPECT_EQ(number(-54321.0), "-54\u202f321");
  EXPECT_EQ(number(1.5e-9), "1.5\u00b710\u207b\u2079");
  EXPECT_EQ(number(std::nan("")), "\u2013");
  EXPECT_EQ(duration(754), "12 min 34 s");
  EXPECT_EQ(duration(7500), "2 h 5 min");
  EXPECT_EQ(memory(412e6), "412 MB");
}

TEST(Format, MakesTextSafe) {
  EXPECT_EQ(html("<a href=\"x\">&'"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
  EXPECT_EQ(script_json("{\"a\":\"</script>\"}"), "{\"a\":\"\\u003c/script>\"}");
}

}  // namespace
}  // namespace sluice
