#include "identification/lack_of_fit/asked_features.h"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kRows = 60;

MatrixXd Random(Index count, std::uint64_t seed) {
  RandomStream random({seed, 0}, Stream::test);
  return MatrixXd::NullaryExpr(kRows, count, [&] { return random.Normal(); });
}

/// Two features of two columns and of three beside a basis of two, in four parts of which one is empty.
class Asked : public ::testing::Test {
 protected:
  const MatrixXd basis =
      Eigen::HouseholderQR<MatrixXd>(Random(2, 1)).householderQ() * MatrixXd::Identity(kRows, 2);
  const VectorXd residual = Random(1, 2), roots = Random(1, 3).cwiseAbs();
  const MatrixXd columns = Random(3, 4);
  const AskedFeatures asked{
      residual, basis, {{Random(2, 5)}, {columns, 7, 2.5}}, roots, {10, 10, 31, kRows}};
  const OwnBasis own = asked.Beside(1, 0.02);
  const MatrixXd rows = asked.Rows(own);
};

TEST_F(Asked, AddsToTheFitWhatItDoesNotHold) {
  ASSERT_EQ(own.size(), 3);
  // rounding of 60 products of at most 1, over the least that a column has beside the others
  EXPECT_LT((rows.transpose() * rows - MatrixXd::Identity(3, 3)).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT((rows.transpose() * basis).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT((own.b - rows.transpose() * residual).cwiseAbs().maxCoeff(), 1e-13);
  // with the basis it spans the weighed features
  MatrixXd left = roots.asDiagonal() * columns;
  left -= basis * (basis.transpose() * left) + rows * (rows.transpose() * left);
  EXPECT_LT(left.cwiseAbs().maxCoeff(), 1e-13);
}

TEST_F(Asked, KnowsSquaresAndScoresOfEachPart) {
  const VectorXd left =
      residual - basis * (basis.transpose() * residual) - rows * (rows.transpose() * residual);
  const VectorXd shares = asked.Shares(own);
  const MatrixXd scores = asked.Scores(own);
  Index begin = 0, part = 0;
  for (const Index end : {Index{10}, Index{10}, Index{31}, kRows}) {
    const auto inside = rows.middleRows(begin, end - begin);
    EXPECT_NEAR(shares[part], inside.squaredNorm(), 1e-13);
    const VectorXd score = inside.transpose() * left.segment(begin, end - begin);
    EXPECT_LT((scores.row(part).transpose() - score).cwiseAbs().maxCoeff(), 1e-13);
    begin = end;
    ++part;
  }
}

TEST_F(Asked, TellsWhatFeaturesAreTheBestOf) {
  EXPECT_EQ(asked.place(0).candidates, 1);
  EXPECT_EQ(asked.place(1).candidates, 7);
  EXPECT_EQ(asked.place(1).period, 2.5);
}

TEST_F(Asked, FindsNothingBesideWhatHoldsIt) {
  const AskedFeatures held{residual, basis, {{basis.col(0)}}, VectorXd::Ones(kRows), {kRows}};
  EXPECT_EQ(held.Beside(0, 0.02).size(), 0);
}

}  // namespace
}  // namespace warmjoint
