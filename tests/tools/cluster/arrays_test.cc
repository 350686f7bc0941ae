#include "tools/cluster/arrays.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

namespace warmjoint {
namespace {

using testing::ElementsAre;

std::vector<int> UpTo(int last) {
  std::vector<int> numbers(static_cast<std::size_t>(last));
  std::iota(numbers.begin(), numbers.end(), 1);
  return numbers;
}

TEST(Arrays, EveryShardHasOneIndexBelowTheBound) {
  const std::vector<JobArray> arrays = ArraysOf(UpTo(3000), 1001, 0);
  ASSERT_EQ(arrays.size(), 3u);
  EXPECT_EQ(arrays[0].indices, "0-1000");
  EXPECT_EQ(arrays[1].indices, "0-1000");
  EXPECT_EQ(arrays[2].indices, "0-997");
  EXPECT_EQ(arrays[1].offset, 1001);
  EXPECT_EQ(arrays[2].offset, 2002);
  EXPECT_EQ(arrays[2].shards.back(), 3000);
}

TEST(Arrays, HoldWhatIsMissingAlone) {
  const std::vector<JobArray> arrays = ArraysOf({3, 4, 5, 9, 12, 13}, 10, 0);
  ASSERT_EQ(arrays.size(), 2u);
  EXPECT_EQ(arrays[0].indices, "2-4,8");
  EXPECT_EQ(arrays[1].indices, "1-2");
  EXPECT_THAT(arrays[1].shards, ElementsAre(12, 13));
}

TEST(Arrays, ShareTheTasksAtATime) {
  const std::vector<JobArray> arrays = ArraysOf(UpTo(30), 10, 7);
  for (const JobArray& array : arrays) EXPECT_EQ(array.indices, "0-9%2");
  EXPECT_EQ(ArraysOf(UpTo(30), 10, 1)[0].indices, "0-9%1");
}

}  // namespace
}  // namespace warmjoint
