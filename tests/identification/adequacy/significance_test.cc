#include "identification/adequacy/significance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

TEST(HotellingDeviations, AreOfChanceForChance) {
  // scores of 32 parts, each standard normal: 5 % of 1000 draws beyond 1.960, less three times
  // their own deviation of 0.7 %
  RandomStream random({1, 0}, Stream::test);
  int beyond = 0;
  for (int draw = 0; draw < 1000; ++draw) {
    Eigen::MatrixXd scores(3, 32);
    for (double& score : scores.reshaped()) score = random.Normal();
    const Eigen::VectorXd sum = scores.rowwise().sum();
    const Eigen::MatrixXd centred = scores.colwise() - sum / 32;
    const Eigen::MatrixXd scatter = 32.0 / 31 * centred * centred.transpose();
    beyond += HotellingDeviations(sum, scatter, 32) > 1.960;
  }
  EXPECT_NEAR(beyond, 50, 21);
}

TEST(HotellingDeviations, AreNoneForTooFewParts) {
  EXPECT_EQ(HotellingDeviations(Eigen::Vector2d(100, 100), Eigen::Matrix2d::Identity(), 4), 0);
}

}  // namespace
}  // namespace warmjoint
