#include "base/units.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace sluice {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

struct Reading {
  const char* text;
  const char* unit;
  double value;
};

TEST(Units, ReadWhatPlantsWrite) {
  const double degree = std::numbers::pi / 180;
  for (const Reading& r : {Reading{"1200 t/h", "kg/s", 1200 / 3.6},
                           Reading{"1200 tph", "kg/s", 1200 / 3.6},
                           Reading{"450 m3/h", "m3/s", 0.125},
                           Reading{"25 mm", "m", 0.025},
                           Reading{"25mm", "m", 0.025},
                           Reading{"-1.5e2 mm", "m", -0.15},
                           Reading{"1 in", "m", 0.0254},
                           Reading{"35 deg", "rad", 35 * degree},
                           Reading{"35°", "rad", 35 * degree},
                           Reading{"2 bar", "Pa", 2e5},
                           Reading{"1 mPa s", "Pa s", 1e-3},
                           Reading{"1 cP", "Pa s", 1e-3},
                           Reading{"60 l/min", "m3/s", 1e-3},
                           Reading{"1000 kg/m3", "kg/m3", 1000},
                           Reading{"9.81 m/s2", "m/s2", 9.81},
                           Reading{"9.81 m/s^2", "m/s2", 9.81},
                           Reading{"9.81 m s-2", "m/s2", 9.81},
                           Reading{"2 min", "s", 120},
                           Reading{"0.5", "", 0.5},
                           Reading{"35 %", "", 0.35},
                           Reading{"35%", "", 0.35},
                           Reading{"0", "", 0},
                           Reading{"900 rpm", "Hz", 15},
                           Reading{"25 1/s", "Hz", 25},
                           Reading{"60 rpm", "rad/s", 2 * std::numbers::pi},
                           Reading{".5 m", "m", 0.5},
                           Reading{"3 t", "kg", 3000},
                           Reading{" 7 MN/m ", "N/m", 7e6},
                           Reading{"1 m³", "m3", 1}}) {
    const Quantity q = read_quantity(r.text, r.unit);
    ASSERT_TRUE(q.value) << r.text << ": " << q.problem;
    EXPECT_NEAR(*q.value, r.value, 8 * eps * std::abs(r.value)) << r.text;
  }
}

struct Refusal {
  const char* text;
  const char* unit;
  const char* problem;
  const char* reason;
  const char* suggestion;
};

TEST(Units, SayWhatIsWrongWithAQuantity) {
  for (const Refusal& r :
       {Refusal{"25 kg", "m", "has unit 'kg'", "a length is needed", "use m, mm or in"},
        Refusal{"25", "m", "is '25', without a unit", "a length is needed", "use m, mm or in"},
        Refusal{"450 m3/h", "kg/s", "has unit 'm3/h'", "a mass flow is needed", "use t/h or kg/s"},
        Refusal{"25 bananas", "m", "has unit 'bananas', which is not known", "a length is needed",
                "use m, mm or in"},
        Refusal{"3 mm", "", "has unit 'mm'", "a plain number is needed", "leave the unit out"},
        Refusal{"10 rad/s", "Hz", "has unit 'rad/s'", "a frequency is needed", "use Hz, 1/min or rpm"},
        Refusal{"10 Hz", "rad/s", "has unit 'Hz'", "an angular speed is needed", "use rpm, deg/s or rad/s"},
        Refusal{"wide", "m", "is 'wide'", "a length is needed", "write a number and its unit, as in '1 m'"},
        Refusal{"1.2 ton/h", "kg/s", "has unit 'ton/h'", "a ton is 907, 1000 or 1016 kg",
                "use t (1000 kg), short_ton or long_ton"}}) {
    const Quantity q = read_quantity(r.text, r.unit);
    EXPECT_FALSE(q.value) << r.text;
    EXPECT_EQ(q.problem, r.problem);
    EXPECT_EQ(q.reason, r.reason);
    EXPECT_EQ(q.suggestion, r.suggestion);
  }
}

TEST(Units, RefuseWhatIsNotAFiniteDecimalNumber) {
  for (const char* text : {"nan m", ".nan", "NaN", "inf", "-.inf m", "infinity m", "1e999 m", "010 m",
                           "-007 m", "0x10 m", "1,5 m", "1,200 m", "", "m", "--1 m", "1e m", ". m"})
    EXPECT_FALSE(read_quantity(text, "m").value) << text;
  for (const char* text : {".nan", ".inf", "010", "0x1F", "1'000"})
    EXPECT_FALSE(read_quantity(text, "").value) << text;
}

TEST(Units, SuggestTheNumberWithoutItsLeadingZero) {
  EXPECT_EQ(read_quantity("010 mm", "m").suggestion, "write '10 mm'");
  EXPECT_EQ(read_quantity("-0010", "").suggestion, "write '-10'");
  EXPECT_EQ(read_quantity("00", "").suggestion, "write '0'");
}

TEST(Units, RefuseNumbersHiddenInTheUnit) {
  for (const char* text : {"25 3 mm", "3 m - 1 m", "10 m 3", "5 mm @ 2", "3 m since 1990", "2 m+1 m"})
    EXPECT_FALSE(read_quantity(text, "m").value) << text;
}

TEST(Units, ShowValuesInTheUnitsOfThePlant) {
  EXPECT_EQ(for_people(0.025, "m"), "25 mm");
  EXPECT_EQ(for_people(2.4, "m"), "2.4 m");
  EXPECT_EQ(for_people(1e-3, "m"), "1 mm");
  EXPECT_EQ(for_people(5e-6, "m"), "5 um");
  EXPECT_EQ(for_people(1200 / 3.6, "kg/s"), "1200 t/h");
  EXPECT_EQ(for_people(0.125, "m3/s"), "450 m3/h");
  EXPECT_EQ(for_people(std::numbers::pi / 4, "rad"), "45 deg");
  EXPECT_EQ(for_people(0, "m"), "0 m");
  EXPECT_EQ(for_people(0.35, ""), "0.35");
  EXPECT_EQ(for_people(1234567, ""), "1234567");
  EXPECT_EQ(for_people(-2e5, "Pa"), "-200 kPa");
  EXPECT_EQ(for_people(3, "furlong"), "3 furlong");
}

TEST(Units, ShownValuesReadBack) {
  for (const char* unit : {"m", "s", "kg", "kg/s", "m3/s", "rad", "Pa", "Pa s", "N", "N/m", "J"})
    for (double value : {1.25e-4, 0.03, 1.0, 47.0, 5.2e4}) {
      const Quantity q = read_quantity(for_people(value, unit), unit);
      ASSERT_TRUE(q.value) << for_people(value, unit) << ": " << q.problem;
      EXPECT_NEAR(*q.value, value, 5e-6 * value) << for_people(value, unit);
    }
}

}  // namespace
}  // namespace sluice
