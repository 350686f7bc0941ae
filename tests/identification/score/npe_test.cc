#include <gtest/gtest.h>
#include <warmjoint/score.h>

#include <cmath>

#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

TEST(NormalisedParameterError, ReproducesTheGoldenNumber) {
  const nlohmann::json& golden = test::Golden().at("npe");
  const Eigen::VectorXd estimate = test::ToVector(golden.at("xhat"));
  const Eigen::VectorXd truth = test::ToVector(golden.at("x"));
  const double total = golden.at("total");
  EXPECT_NEAR(NormalisedParameterError(estimate, truth), total, 1e-12 * total);  // closed form
}

TEST(NormalisedParameterError, IsWhatAHandMakesOfThreeParameters) {
  // a tenth, a fifth of a negative one, and none: sqrt(0.01 + 0.04)
  EXPECT_DOUBLE_EQ(
      NormalisedParameterError(Eigen::Vector3d(5.5, -8, 600), Eigen::Vector3d(5, -10, 600)),
      std::sqrt(0.05));
}

TEST(NormalisedParameterError, CountsAMissingParameterAsAWholeError) {
  EXPECT_EQ(NormalisedParameterError(Eigen::Vector2d(5, 0), Eigen::Vector2d(5, -3)), 1);
}

}  // namespace
}  // namespace warmjoint
