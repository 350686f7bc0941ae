#include "tools/suite/shard.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "models/foundation/bad_input.h"

namespace warmjoint {
namespace {

TEST(Shard, BlocksFollowOneAnotherWithoutGapsAndAreAlike) {
  for (const int realizations : {20, 2, 2'000'000'000}) {
    for (const int count : {1, 3, 7}) {
      int end = 0, least = realizations, most = 0;
      for (int index = 1; index <= count; ++index) {
        const Shard shard{index, count};
        EXPECT_EQ(shard.First(realizations), end);
        end = shard.End(realizations);
        least = std::min(least, end - shard.First(realizations));
        most = std::max(most, end - shard.First(realizations));
      }
      EXPECT_EQ(end, realizations);
      EXPECT_LE(most - least, 1);
    }
  }
  EXPECT_TRUE(Shard().IsWhole());
  EXPECT_EQ(ReadShard("2/3").index, 2);
}

TEST(Shard, RefusesWhatIsNoPart) {
  for (const char* text : {"", "1", "0/3", "4/3", "1/0", "a/b", "1/3/5", "-1/3", "2:3"}) {
    EXPECT_THROW(ReadShard(text), BadInput) << text;
  }
}

}  // namespace
}  // namespace warmjoint
