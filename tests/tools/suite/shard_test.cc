#include "tools/suite/shard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/bad_input.h"

namespace warmjoint {
namespace {

TEST(Shard, EveryRealizationIsInExactlyOne) {
  for (int realization = 0; realization < 20; ++realization) {
    int holders = 0;
    for (const char* text : {"1/3", "2/3", "3/3"}) {
      holders += ReadShard(text).Holds({0, realization}) ? 1 : 0;
    }
    EXPECT_EQ(holders, 1) << realization;
  }
}

TEST(Shard, ARangeHoldsItsRealizationsAndMayBeEmpty) {
  const Shard range = ReadShard("2:5");
  EXPECT_FALSE(range.Holds({0, 1}));
  EXPECT_TRUE(range.Holds({3, 2}));
  EXPECT_TRUE(range.Holds({0, 4}));
  EXPECT_FALSE(range.Holds({0, 5}));
  EXPECT_FALSE(ReadShard("5:5").Holds({0, 5}));
  EXPECT_FALSE(range.IsWhole());
  EXPECT_TRUE(Shard().IsWhole());
}

TEST(Shard, RefusesWhatIsNoPart) {
  for (const char* text :
       {"", "1", "0/3", "4/3", "1/0", "a/b", "1/3/5", "-1/3", "3:2", "-1:2", "1:", "a:b"}) {
    EXPECT_THROW(ReadShard(text), BadInput) << text;
  }
}

}  // namespace
}  // namespace warmjoint
