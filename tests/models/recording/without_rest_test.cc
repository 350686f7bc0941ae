#include "models/recording/without_rest.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

TEST(WithoutRest, LeavesOutSamplesOfVelocityZeroAlone) {
  Measurements m;
  m.velocity = Eigen::Vector4d(0, 1, -1e-9, 2);
  Selection selection;
  selection.segments = {{0, 4, 1}};
  selection.keep.resize(4);
  selection.keep << true, true, true, false;
  const Selection moving = WithoutRest(selection, m);
  EXPECT_FALSE(moving.keep[0]);
  EXPECT_TRUE(moving.keep[1]);
  EXPECT_TRUE(moving.keep[2]);
  EXPECT_FALSE(moving.keep[3]);
  EXPECT_EQ(moving.segments.size(), 1u);
}

}  // namespace
}  // namespace warmjoint
