#include "models/recording/sampling.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

TEST(LongestStep, IsThreeMedianSteps) {
  Eigen::VectorXd time(6);
  time << 0, 0.1, 0.2, 0.3, 0.4, 100;
  EXPECT_DOUBLE_EQ(LongestStep(time), 3 * (0.3 - 0.2));
}

}  // namespace
}  // namespace warmjoint
