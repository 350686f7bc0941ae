#include "identification/uncertainty/disagreement.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

constexpr double kMany = 1e6;  // degrees of freedom

FitOfRows TwoRows(double first, double second, double variance) {
  return {Eigen::Vector2d(first, second), variance * Eigen::Matrix2d::Identity()};
}

TEST(Disagreement, IsADifferenceThatNoiseDoesNotMake) {
  // the difference has the variance 4 - 3 = 1: two parameters ask for a little more than 5 deviations
  EXPECT_FALSE(FindDisagreement(TwoRows(0, 0, 4), TwoRows(5, 5, 3), kMany));
  const auto found = FindDisagreement(TwoRows(0, 0, 4), TwoRows(1, -5.3, 3), kMany);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->parameter, 1);
  EXPECT_DOUBLE_EQ(found->difference, -5.3);
  EXPECT_DOUBLE_EQ(found->deviations, 5.3);
  // which a variance that is known from a few samples alone may make
  EXPECT_FALSE(FindDisagreement(TwoRows(0, 0, 4), TwoRows(1, -5.3, 3), 10));
}

TEST(Disagreement, CountsATenthOfTheVarianceWhereBothFitsAreAsGood) {
  // a tenth of the variance counts: sqrt(0.1) 5.2 = 1.64 deviations of the fits themselves
  EXPECT_FALSE(FindDisagreement(TwoRows(0, 0, 1), TwoRows(1.5, 0, 1), kMany));
  EXPECT_TRUE(FindDisagreement(TwoRows(0, 0, 1), TwoRows(1.7, 0, 1), kMany));
  EXPECT_FALSE(FindDisagreement(TwoRows(0, 0, 1), TwoRows(0, 0, 1), kMany));
}

}  // namespace
}  // namespace warmjoint
