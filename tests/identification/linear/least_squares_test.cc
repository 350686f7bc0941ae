#include "identification/linear/least_squares.h"

#include <gmock/gmock.h>

#include <Eigen/LU>

namespace warmjoint {
namespace {

TEST(LeastSquares, AgreesWithTheNormalEquations) {
  const Eigen::MatrixXd A = (Eigen::MatrixXd(5, 2) << 1, 2, 3, 1, -1, 4, 2, 2, 0, 1).finished();
  const Eigen::VectorXd y = (Eigen::VectorXd(5) << 1, 0, 2, -1, 3).finished();
  const LeastSquares fit = SolveLeastSquares(A, y);
  const Eigen::MatrixXd cofactor = (A.transpose() * A).inverse();
  EXPECT_EQ(fit.rank, 2);
  EXPECT_TRUE(fit.cofactor.isApprox(cofactor, 1e-12));  // rounding of a 2 x 2 problem
  EXPECT_TRUE(fit.solution.isApprox(cofactor * A.transpose() * y, 1e-12));
}

TEST(LeastSquares, IsUnmovedByTheUnitsOfItsColumns) {
  Eigen::MatrixXd A = (Eigen::MatrixXd(4, 2) << 1, 2, 3, 1, -1, 4, 2, 2).finished();
  const Eigen::VectorXd y = (Eigen::VectorXd(4) << 1, 0, 2, -1).finished();
  const Eigen::VectorXd plain = SolveLeastSquares(A, y).solution;
  A.col(1) *= 1e-9;
  const Eigen::VectorXd scaled = SolveLeastSquares(A, y).solution;
  EXPECT_NEAR(scaled[1] * 1e-9, plain[1], 1e-12);
  EXPECT_NEAR(scaled[0], plain[0], 1e-12);
}

TEST(LeastSquares, NamesTheColumnsThatCannotBeToldApart) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(6, 4);
  A.col(3) = -2 * A.col(1);
  const LeastSquares fit = SolveLeastSquares(A, Eigen::VectorXd::Ones(6));
  EXPECT_EQ(fit.rank, 3);
  EXPECT_EQ(fit.solution.size(), 0);
  EXPECT_THAT(fit.mixed, ::testing::ElementsAre(1, 3));
}

TEST(LeastSquares, TakesASpeedThatVariesByAPercentForConstant) {
  // [v, sign v] with v = 1 +- 0.01 and with v = 1 +- 0.05
  Eigen::MatrixXd A = Eigen::MatrixXd::Ones(100, 2);
  for (int i = 0; i < 100; ++i) A(i, 0) = i % 2 ? 1.01 : 0.99;
  EXPECT_EQ(SolveLeastSquares(A, Eigen::VectorXd::Ones(100)).rank, 1);
  for (int i = 0; i < 100; ++i) A(i, 0) = i % 2 ? 1.05 : 0.95;
  EXPECT_EQ(SolveLeastSquares(A, Eigen::VectorXd::Ones(100)).rank, 2);
}

}  // namespace
}  // namespace warmjoint
