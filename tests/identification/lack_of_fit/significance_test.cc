#include "identification/lack_of_fit/significance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

TEST(HotellingPValue, IsUniformForChance) {
  // scores of 32 parts, each standard normal: 5 % of 1000 draws below 0.05, within three times
  // their own deviation of 0.7 %
  RandomStream random({1, 0}, Stream::test);
  int below = 0;
  for (int draw = 0; draw < 1000; ++draw) {
    Eigen::MatrixXd scores(3, 32);
    for (double& score : scores.reshaped()) score = random.Normal();
    const Eigen::VectorXd sum = scores.rowwise().sum();
    const Eigen::MatrixXd centred = scores.colwise() - sum / 32;
    const Eigen::MatrixXd scatter = 32.0 / 31 * centred * centred.transpose();
    below += HotellingPValue(sum, scatter, 32) < 0.05;
  }
  EXPECT_NEAR(below, 50, 21);
}

TEST(HotellingPValue, IsOneForTooFewParts) {
  EXPECT_EQ(HotellingPValue(Eigen::Vector2d(100, 100), Eigen::Matrix2d::Identity(), 4), 1);
}

}  // namespace
}  // namespace warmjoint
