#include "models/foundation/low_pass.h"

#include <gtest/gtest.h>

#include <cmath>

namespace warmjoint {
namespace {

TEST(LowPass, FollowsAStepByTheExponential) {
  const Eigen::VectorXd time = Eigen::Vector4d(0, 0.1, 0.3, 1);
  Eigen::VectorXd x = Eigen::Vector4d(0, 1, 1, 1);
  const Eigen::VectorXd y = LowPass(time, x, 0.2);
  EXPECT_EQ(y[1], 0) << "the step drives from its own sample on";
  EXPECT_NEAR(y[2], 1 - std::exp(-0.2 / 0.2), 1e-15);
  EXPECT_NEAR(y[3], 1 - std::exp(-0.9 / 0.2), 1e-15);
}

TEST(LowPass, IsSettledOnTheFirstSample) {
  const Eigen::VectorXd y =
      LowPass(Eigen::VectorXd::LinSpaced(9, 0, 2), Eigen::VectorXd::Constant(9, -3), 0.5);
  EXPECT_EQ(y, Eigen::VectorXd::Constant(9, -3));
}

}  // namespace
}  // namespace warmjoint
