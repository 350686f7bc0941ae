#include "identification/uncertainty/draw_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace warmjoint {
namespace {

/// Mean product of samples that are `lag` apart.
double Covariance(const Eigen::VectorXd& drawn, Eigen::Index lag) {
  const Eigen::Index n = drawn.size() - lag;
  return drawn.head(n).dot(drawn.tail(n)) / static_cast<double>(n);
}

TEST(DrawNoise, HasTheCovariancesOfItsModel) {
  // e[i] = 0.8 e[i-1] + w, of variance 2: covariances 2 * 0.8^lag
  NoiseModel noise;
  noise.coefficients = Eigen::VectorXd::Constant(1, -0.8);
  noise.variance = 2;
  noise.innovation = 2 * (1 - 0.64);
  noise.covariances = Eigen::Vector2d(2, 1.6);
  StartStream stream({});
  const Eigen::Index n = 200000;
  const Eigen::VectorXd drawn = DrawNoise(noise, n, 1, stream);
  ASSERT_EQ(drawn.size(), n);
  // four deviations of a mean product of n samples, of which (1 + 0.64) / (1 - 0.64) tell as much as one
  const double tolerance = 4 * 2 * std::sqrt(2 * 4.6 / static_cast<double>(n));
  for (const Eigen::Index lag : {0, 1, 2, 5, 50}) {
    EXPECT_NEAR(Covariance(drawn, lag), 2 * std::pow(0.8, lag), tolerance) << lag;
  }
}

TEST(DrawNoise, IsStationaryFromItsFirstSampleOn) {
  NoiseModel noise;
  noise.coefficients = Eigen::VectorXd::Constant(1, -0.95);
  noise.variance = 1;
  noise.innovation = 1 - 0.95 * 0.95;
  noise.covariances = Eigen::Vector2d(1, 0.95);
  StartStream stream({});
  const Eigen::Index draws = 4000;
  const double squares = DrawNoise(noise, 200, draws, stream).row(0).squaredNorm();
  EXPECT_NEAR(squares / draws, 1, 4 * std::sqrt(2.0 / draws));
}

TEST(DrawNoise, OfAWhiteModelIsWhite) {
  NoiseModel noise;
  noise.variance = 0.25;
  noise.covariances = Eigen::VectorXd::Constant(1, 0.25);
  StartStream stream({});
  const Eigen::Index n = 100000;
  const Eigen::VectorXd drawn = DrawNoise(noise, n, 1, stream);
  EXPECT_NEAR(Covariance(drawn, 0), 0.25, 4 * 0.25 * std::sqrt(2.0 / n));
  EXPECT_NEAR(Covariance(drawn, 1), 0, 4 * 0.25 / std::sqrt(n));
}

}  // namespace
}  // namespace warmjoint
