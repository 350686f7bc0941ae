#include "identification/score/npe.h"

#include <gtest/gtest.h>

#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

TEST(NormalisedParameterError, ReproducesTheGoldenNumber) {
  WARMJOINT_NEED_SHARED("golden/golden.json");
  const nlohmann::json& golden = test::Golden().at("npe");
  const Eigen::VectorXd estimate = test::ToVector(golden.at("xhat"));
  const Eigen::VectorXd truth = test::ToVector(golden.at("x"));
  const double total = golden.at("total");
  EXPECT_NEAR(NormalisedParameterError(estimate, truth), total, 1e-12 * total);  // closed form
}

TEST(NormalisedParameterError, CountsAMissingParameterAsAWholeError) {
  EXPECT_EQ(NormalisedParameterError(Eigen::Vector2d(5, 0), Eigen::Vector2d(5, -3)), 1);
}

}  // namespace
}  // namespace warmjoint
