#include "models/foundation/start_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace warmjoint {
namespace {

TEST(StartStream, DrawsUniformly) {
  // mean of a million: 3 standard deviations of 4/sqrt(12 million)
  StartStream stream(StartKey{{1, 2, 3, 4}});
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
  StartStream one(StartKey{{5, 6, 7, 8}}), other(StartKey{{5, 6, 7, 8}});
  for (int i = 0; i < 10; ++i) EXPECT_EQ(one.Uniform(0, 1), other.Uniform(0, 1));
}

}  // namespace
}  // namespace warmjoint
