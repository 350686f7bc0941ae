#include "identification/metrics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "identification/estimate.h"
#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

TEST(Metrics, ReproduceTheGoldenIndicators) {
  const nlohmann::json& golden = test::Golden().at("indicators");
  const int d = golden.at("d");
  const Metrics metrics =
      ComputeMetrics(test::ToVector(golden.at("y")), test::ToVector(golden.at("yhat")), d, d);

  // 1e-12: closed forms
  EXPECT_NEAR(metrics.fit, golden.at("Fit"), 1e-12 * 100);
  EXPECT_NEAR(metrics.fpe, golden.at("FPE"), 1e-12);
  EXPECT_NEAR(metrics.rmse, golden.at("RMSE"), 1e-12);
  EXPECT_NEAR(metrics.mae, golden.at("MAE"), 1e-12);
  EXPECT_EQ(metrics.n, 5);
}

TEST(Metrics, AreWhatAHandMakesOfFourSamples) {
  // errors 1, -1, 3, -1: mean square 12/4, mean size 6/4
  const Eigen::Vector4d measured(2, 4, 6, 8), fitted(1, 5, 3, 9);
  const Metrics metrics = ComputeMetrics(measured, fitted, 1, 1);
  EXPECT_DOUBLE_EQ(metrics.rmse, std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(metrics.mae, 1.5);
  // about the mean 5: 9 + 1 + 1 + 9 = 20
  EXPECT_DOUBLE_EQ(metrics.fit, 100 * (1 - std::sqrt(12.0 / 20)));
  // 3 (1 + 1/4)/(1 - 1/4)
  EXPECT_DOUBLE_EQ(metrics.fpe, 5);
  EXPECT_EQ(metrics.n, 4);
}

TEST(Metrics, KnowNoErrorToPredictWithoutASampleToSpare) {
  // (1 + d/n)/(1 - d/n) has no meaning from d = n on, where it would be negative
  const Eigen::Vector3d measured(1, 2, 6), fitted(1, 2, 5);
  EXPECT_GT(ComputeMetrics(measured, fitted, 2, 2).fpe, 0);
  EXPECT_TRUE(std::isnan(ComputeMetrics(measured, fitted, 3, 3).fpe));
  EXPECT_TRUE(std::isnan(ComputeMetrics(measured, fitted, 40, 3).fpe));
  // nor a constant torque a share to explain
  const Eigen::Vector3d constant(2, 2, 2);
  EXPECT_TRUE(std::isnan(ComputeMetrics(constant, fitted, 1, 1).fit));
}

}  // namespace
}  // namespace warmjoint
