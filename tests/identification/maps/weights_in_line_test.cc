#include "identification/maps/weights_in_line.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

namespace warmjoint {
namespace {

/// Over position and direction.
FrictionMap Map(int count, bool circular) {
  FrictionMap map;
  map.axes.push_back(
      {MapQuantity::position, circular ? CircleAxis(2 * M_PI, count) : EvenAxis(-1, 1, count)});
  map.axes.push_back({MapQuantity::velocity, {{-0.5, 0.5}, 0.5, {}, Sides::apart}});
  return map;
}

// closed form; sums over kernels stand for integrals to 2 exp(-(pi 2.5)^2 / 2) = 1e-13
TEST(CorrelationInLines, IsGaussianFarFromTheEnds) {
  const Eigen::MatrixXd alike =
      CorrelationInLines({Map(40, false)}, std::vector<bool>(80, false), 2.5);
  ASSERT_EQ(alike.rows(), 80);
  for (const int apart : {0, 1, 2, 3}) {
    EXPECT_NEAR(alike(2 * 19, 2 * (19 + apart)), std::exp(-apart * apart / (2 * 2.5 * 2.5)), 1e-12);
  }
  EXPECT_EQ(alike(38, 39), 0) << "forwards and backwards are different lines";
}

TEST(CorrelationInLines, ClosesCirclesAndKeepsMapsApart) {
  const Eigen::MatrixXd alike =
      CorrelationInLines({Map(12, true), Map(10, false)}, std::vector<bool>(44, false), 1);
  EXPECT_NEAR(alike(0, 22), alike(0, 2), 1e-12) << "the last kernel is the first one's neighbour";
  EXPECT_TRUE(alike.topRightCorner(24, 20).isZero(0));
  EXPECT_TRUE(alike.diagonal().isOnes(1e-12));
}

TEST(CorrelationInLines, LeavesUnseenWeightsOut) {
  std::vector<bool> unseen(20, false);
  unseen[2] = unseen[3] = true;
  const Eigen::MatrixXd whole = CorrelationInLines({Map(10, false)}, std::vector<bool>(20), 2);
  const Eigen::MatrixXd part = CorrelationInLines({Map(10, false)}, unseen, 2);
  ASSERT_EQ(part.rows(), 18);
  EXPECT_EQ(part(0, 2), whole(0, 4));
}

TEST(CorrelationInLines, IsACovariance) {
  for (const bool circular : {false, true}) {
    const Eigen::MatrixXd alike =
        CorrelationInLines({Map(12, circular)}, std::vector<bool>(24, false), 4);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> values(alike);
    EXPECT_GT(values.eigenvalues().minCoeff(), -1e-12);  // rounding of 24 ones
  }
}

}  // namespace
}  // namespace warmjoint
