// Cases of an earlier record are kept as they were.

#include "validation/kept_cases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/errors.h"
#include "output/temporary_folder.h"

namespace sluice {
namespace {

ValidationRecord two_cases() {
  ValidationRecord record;
  record.made_by = {"0.1", "abc", "GNU 12", "-O3", "a \"chip\"", 2};
  record.command = "sluice validate";
  for (const char* name : {"drop", "wave"}) {
    ValidationCase c;
    c.name = name;
    c.title = "A title: with a colon";
    c.why = "line\nand 'quotes' \\ \"more\"";
    c.order = 1.25;
    c.made_by = record.made_by;
    c.rungs_in_ladder = 3;
    ValidationRung r;
    r.setting = "8 mm";
    r.number = 0.008;
    r.error = std::nan("");
    r.gate = 0.1;
    r.stable = false;
    r.message = "broke";
    r.seconds = 1e-7;
    r.values = {{"width [m]", 1.0 / 3, 2}};
    c.rungs = {r, r};
    record.cases.push_back(c);
  }
  return record;
}

class KeptCases : public ::testing::Test {
 protected:
  void write(const std::string& text) { std::ofstream(file) << text; }
  TemporaryFolder folder;
  std::filesystem::path file = folder.path / "validation.json";
};

TEST_F(KeptCases, AreReadAsTheyWereWritten) {
  ValidationRecord record = two_cases();
  const std::string text = validation_json(record);
  write(text);
  record.cases = kept_cases(file, {"validation/drop", "validation/wave"});
  EXPECT_EQ(validation_json(record), text);
}

TEST_F(KeptCases, AreThoseThatAreStillThere) {
  write(validation_json(two_cases()));
  const std::vector<ValidationCase> cases = kept_cases(file, {"validation/wave"});
  ASSERT_EQ(cases.size(), 1);
  EXPECT_EQ(cases[0].name, "wave");
  EXPECT_TRUE(kept_cases("no/such/file.json", {"validation/wave"}).empty());
}

TEST_F(KeptCases, OfADamagedRecordAreRefusedWithThePlace) {
  write("{\"cases\": [{\"name\": \"drop\"}]}\n");
  try {
    kept_cases(file, {"validation/drop"});
    FAIL() << "it was taken";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(file.string() + ":1:"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("'title' is missing"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace sluice
