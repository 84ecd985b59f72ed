#include "base/parallel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "base/random.h"

namespace sluice {
namespace {

/// Puts the thread count back at the end of a test.
class Parallel : public testing::Test {
 protected:
  void TearDown() override { set_thread_count(before_); }

 private:
  int before_ = thread_count();
};

std::vector<double> wild_numbers(std::size_t n) {
  Random r(11);
  std::vector<double> x(n);
  for (double& v : x) v = r.normal() * std::pow(10.0, r.uniform(-8, 8));
  return x;
}

TEST_F(Parallel, SumsHaveTheSameBitsForAnyThreadCount) {
  const std::vector<double> x = wild_numbers(100003);
  const auto total = [&] { return parallel_sum<double>(x.size(), [&](std::size_t i) { return x[i]; }); };
  set_thread_count(1);
  const double one = total();
  for (int threads : {2, 3, 5, 8}) {
    set_thread_count(threads);
    EXPECT_EQ(total(), one) << threads << " threads";
  }
}

TEST_F(Parallel, EveryIndexIsVisitedOnce) {
  for (int threads : {1, 2, 3})
    for (std::size_t n : {0u, 1u, 255u, 256u, 257u, 10000u}) {
      set_thread_count(threads);
      std::vector<int> visits(n, 0);
      parallel_for(n, [&](std::size_t i) { ++visits[i]; });
      EXPECT_EQ(visits, std::vector<int>(n, 1)) << n;
    }
}

TEST_F(Parallel, ChunksDoNotDependOnTheThreadCount) {
  for (int threads : {1, 2, 3}) {
    set_thread_count(threads);
    std::vector<std::pair<std::size_t, std::size_t>> chunks(4);
    parallel_chunks(1000, 300, [&](std::size_t c, std::size_t b, std::size_t e) { chunks[c] = {b, e}; });
    const std::vector<std::pair<std::size_t, std::size_t>> wanted{
        {0, 300}, {300, 600}, {600, 900}, {900, 1000}};
    EXPECT_EQ(chunks, wanted);
  }
}

TEST_F(Parallel, TheErrorOfTheLowestChunkIsThrown) {
  for (int threads : {1, 2, 4}) {
    set_thread_count(threads);
    try {
      parallel_for(
          5000,
          [](std::size_t i) {
            if (i >= 700 && i % 100 == 0) throw std::runtime_error(std::to_string(i));
          },
          100);
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "700") << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace sluice
