#include "base/find_by_id.h"

#include <gtest/gtest.h>

#include <array>

namespace sluice {
namespace {

TEST(FindById, FindsEveryIdWhateverTheOrderOfAsking) {
  const std::array<std::uint64_t, 5> ids{7, 3, 11, 2, 5};
  for (const std::array<std::size_t, 5>& order :
       {std::array<std::size_t, 5>{0, 1, 2, 3, 4}, {4, 3, 2, 1, 0}, {2, 0, 1, 4, 3}}) {
    FindById find(ids);
    for (const std::size_t k : order) EXPECT_EQ(find.find(ids[k]), k);
  }
}

TEST(FindById, DoesNotFindWhatIsNotThere) {
  const std::array<std::uint64_t, 3> ids{4, 6, 9};
  FindById find(ids);
  EXPECT_FALSE(find.find(5));
  EXPECT_FALSE(find.find(10));
  EXPECT_EQ(find.find(6), 1u);
  EXPECT_FALSE(FindById({}).find(1));
}

}  // namespace
}  // namespace sluice
