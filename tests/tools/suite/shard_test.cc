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

TEST(Shard, RefusesWhatIsNoPart) {
  for (const char* text : {"", "1", "0/3", "4/3", "1/0", "a/b", "1/3/5", "-1/3"}) {
    EXPECT_THROW(ReadShard(text), BadInput) << text;
  }
}

}  // namespace
}  // namespace warmjoint
