#include "tools/report/figures/axes.h"

#include <gtest/gtest.h>

namespace warmjoint::report {
namespace {

using Eigen::VectorXd;

TEST(LinearAxis, HoldsTheDataWithSomeToSpare) {
  const Axis axis = LinearAxis("y", {Eigen::Vector2d(0, 4), Eigen::Vector2d(2, 10)});
  EXPECT_DOUBLE_EQ(axis.lower, -0.4);
  EXPECT_DOUBLE_EQ(axis.upper, 10.4);
  EXPECT_LT(LinearAxis("y", {Eigen::Vector2d(3, 3)}).lower, 3) << "data without extent";
  EXPECT_LT(LinearAxis("y", {}).lower, LinearAxis("y", {}).upper) << "no data";
}

TEST(BulkAxis, LetsSingleWildOnesLeaveAndCountsThem) {
  VectorXd values = VectorXd::LinSpaced(5000, 0, 1);
  const Axis all = BulkAxis("y", {values});
  EXPECT_LE(all.lower, 0);
  EXPECT_GE(all.upper, 1) << "without wild ones nothing is lost";
  EXPECT_EQ(CountBeyond(all, {values}), 0);
  values[17] = -30;
  values[40] = 50;
  const Axis bulk = BulkAxis("y", {values});
  EXPECT_GT(bulk.lower, -0.5);
  EXPECT_LT(bulk.upper, 1.5);
  EXPECT_LE(bulk.lower, 0);
  EXPECT_GE(bulk.upper, 1);
  EXPECT_EQ(CountBeyond(bulk, {values}), 2);
}

TEST(MagnitudeAxis, IsLogarithmicWhereTheRangeAsksForIt) {
  EXPECT_EQ(MagnitudeAxis("NPE (%)", {Eigen::Vector2d(1, 31)}).scale, Scale::logarithmic);
  EXPECT_EQ(MagnitudeAxis("NPE (%)", {Eigen::Vector2d(1, 29)}).scale, Scale::linear);
  EXPECT_EQ(MagnitudeAxis("NPE (%)", {Eigen::Vector2d(0, 31)}).scale, Scale::linear);
}

TEST(IterationAxis, CountsInWholeNumbersAndLeavesRoomForMarks) {
  const Axis few = IterationAxis(0, 4);
  EXPECT_EQ(few.finest, 1);
  EXPECT_LT(few.lower, 0);
  EXPECT_GT(few.upper, 4);
  const Axis many = IterationAxis(0, 500);
  EXPECT_EQ(many.scale, Scale::logarithmic);
  EXPECT_EQ(many.lower, 1) << "a logarithmic axis has no 0";
  EXPECT_EQ(many.upper, 500);
}

}  // namespace
}  // namespace warmjoint::report
