#include "models/foundation/start_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

TEST(StartStream, DrawsUniformly) {
  // mean of a million: 3 standard deviations of 4/sqrt(12 million)
  StartStream stream(StartKeyOf(1, 1));
  double sum = 0, least = 10, greatest = -10;
  for (int i = 0; i < 1000000; ++i) {
    const double x = stream.Uniform(-1, 3);
    sum += x;
    least = std::min(least, x);
    greatest = std::max(greatest, x);
  }
  EXPECT_NEAR(sum / 1e6, 1, 3 * 4 / std::sqrt(12 * 1e6));
  EXPECT_GE(least, -1);
  EXPECT_LT(greatest, 3);
}

TEST(StartStream, GivesTheSameForTheSameKey) {
  StartStream one(StartKeyOf(5, 6)), other(StartKeyOf(5, 6));
  for (int i = 0; i < 10; ++i) EXPECT_EQ(one.Uniform(0, 1), other.Uniform(0, 1));
}

}  // namespace
}  // namespace warmjoint
