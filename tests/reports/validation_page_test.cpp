#include "reports/validation_page.h"

#include <gtest/gtest.h>

namespace sluice {
namespace {

ValidationRecord sample() {
  ValidationCase c;
  c.name = "drop";
  c.title = "A drop";
  c.group = "water";
  c.norm = "largest difference";
  c.vary = "cells";
  c.particle = "point";
  c.source = "somebody <1900>";
  c.rungs_in_ladder = 2;
  c.order = 1.01;
  for (const double error : {0.2, 0.1}) {
    ValidationRung r;
    r.setting = error == 0.2 ? "8" : "16";
    r.error = error;
    r.gate = 0.15;
    r.seconds = 0.1 / error;
    r.particle_steps = 1e6;
    r.command = "sluice validate drop --rung '" + r.setting + "'";
    r.values = {{"width [m]", 1 + error, 1}};
    c.rungs.push_back(r);
  }
  ValidationRecord record;
  record.made_by.commit = "abc123";
  record.command = "sluice validate --threads 2";
  record.made_by.threads = 2;
  record.cases = {c};
  return record;
}

TEST(ValidationPage, HasProvenanceChartGateAndCommand) {
  const std::string page = validation_html(sample());
  for (const char* text :
       {"abc123", "2 threads", "<svg class=\"chart\"", "sluice validate drop --rung &#39;16&#39;", "FAIL",
        "somebody &lt;1900&gt;", "stroke-dasharray"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(page.find("http"), std::string::npos) << "an address";
}

TEST(ValidationPage, SaysTheSameInMarkdown) {
  const std::string page = validation_markdown(sample());
  EXPECT_NE(page.find("| 8 | 0.2 | 0.15 |"), std::string::npos);
  EXPECT_NE(page.find("a gate FAILED"), std::string::npos);
  EXPECT_NE(page.find("`sluice validate drop --rung '16'`"), std::string::npos);
}

TEST(ValidationRecord, PassesWhenEveryGateDoes) {
  ValidationRecord record = sample();
  EXPECT_FALSE(record.passed());
  record.cases[0].rungs[0].gate.reset();
  EXPECT_TRUE(record.passed());
  record.cases[0].least_order = 1.5;
  EXPECT_FALSE(record.passed());
  record.cases[0].rungs_in_ladder = 3;  // order is judged on a whole ladder only
  EXPECT_TRUE(record.passed());
  record.cases[0].rungs[1].stable = false;
  EXPECT_FALSE(record.passed());
}

TEST(ValidationJson, WritesNullForWhatIsNoNumber) {
  ValidationRecord record = sample();
  record.cases[0].rungs[0].error = std::numeric_limits<double>::quiet_NaN();
  record.cases[0].rungs[0].message = "broke: \"x\"\n";
  const std::string json = validation_json(record);
  EXPECT_NE(json.find("\"error\": null"), std::string::npos);
  EXPECT_NE(json.find("broke: \\\"x\\\"\\u000a"), std::string::npos);
}

}  // namespace
}  // namespace sluice
