#pragma once
/// A case of its own for a test, removed with it.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace sluice {

class TemporaryCase {
 public:
  TemporaryCase(const std::string& yaml, const std::string& table) {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(::testing::TempDir()) /
            (std::string("sluice_case_") + test->test_suite_name() + "_" + test->name());
    std::filesystem::create_directories(path_);
    std::ofstream(path_ / "case.yaml") << yaml;
    std::ofstream(path_ / "reference.csv") << table;
  }
  ~TemporaryCase() { std::filesystem::remove_all(path_); }
  TemporaryCase(const TemporaryCase&) = delete;
  TemporaryCase& operator=(const TemporaryCase&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A good case, with one text replaced.
inline std::string sample_case(const std::string& from = "", const std::string& to = "") {
  std::string yaml =
      "title: A rebound\n"
      "group: rocks\n"
      "measure: rock_rebound\n"
      "ladder:\n"
      "  vary: steps_per_contact\n"
      "  rungs: [{at: 8, gate: 0.06}, {at: 20, gate: 0.02}, {at: 50, gate: 0.007}]\n"
      "  least_order: 0.9\n"
      "norm: largest\n"
      "reference: {source: closed form, table: reference.csv}\n"
      "why: first order\n";
  if (!from.empty()) yaml.replace(yaml.find(from), from.size(), to);
  return yaml;
}

}  // namespace sluice
