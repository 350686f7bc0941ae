#include "tools/suite/start_key.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

TEST(StartKeyOf, IsTheDigestOfSeedAndRealization) {
  // sha256sum of "warmjoint identifier start 7 2", its first 16 digits
  EXPECT_EQ(StartKeyOf(7, 2).digest[0], 0x81ec39becd243c62ull);
  EXPECT_NE(StartKeyOf(7, 2), StartKeyOf(7, 3));
  EXPECT_NE(StartKeyOf(7, 2), StartKeyOf(8, 2));
  // 1 and 23 are not 12 and 3
  EXPECT_NE(StartKeyOf(1, 23), StartKeyOf(12, 3));
}

}  // namespace
}  // namespace warmjoint
