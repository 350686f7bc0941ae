#include "identification/adequacy/significance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

// quantiles of F as tables print them (Abramowitz and Stegun, table 26.9): the 1 % points, which
// are 2.3263 standard deviations; Paulson's cube root holds to about 0.01 for n >= 10
TEST(NormalOfF, AgreesWithTables) {
  EXPECT_NEAR(NormalOfF(10.04, 1, 10), 2.3263, 0.03);
  EXPECT_NEAR(NormalOfF(3.90, 5, 24), 2.3263, 0.03);
  EXPECT_NEAR(NormalOfF(4.51, 3, 30), 2.3263, 0.03);
  EXPECT_NEAR(NormalOfF(2.96, 6, 120), 2.3263, 0.03);
}

TEST(NormalOfF, GrowsWithF) {
  double before = NormalOfF(0, 3, 29);
  for (double f = 0.1; f < 1000; f *= 1.5) {
    EXPECT_GT(NormalOfF(f, 3, 29), before);
    before = NormalOfF(f, 3, 29);
  }
}

TEST(HotellingDeviations, AreOfChanceForChance) {
  // scores of 32 parts, each standard normal: 5 % of 1000 draws beyond 1.645, less three times
  // their own deviation of 0.7 %
  RandomStream random({1, 0}, Stream::test);
  int beyond = 0;
  for (int draw = 0; draw < 1000; ++draw) {
    Eigen::MatrixXd scores(3, 32);
    for (double& score : scores.reshaped()) score = random.Normal();
    const Eigen::VectorXd sum = scores.rowwise().sum();
    const Eigen::MatrixXd centred = scores.colwise() - sum / 32;
    const Eigen::MatrixXd scatter = 32.0 / 31 * centred * centred.transpose();
    beyond += HotellingDeviations(sum, scatter, 32) > 1.645;
  }
  EXPECT_NEAR(beyond, 50, 21);
}

TEST(HotellingDeviations, AreNoneForTooFewParts) {
  EXPECT_EQ(HotellingDeviations(Eigen::Vector2d(100, 100), Eigen::Matrix2d::Identity(), 4), 0);
}

}  // namespace
}  // namespace warmjoint
