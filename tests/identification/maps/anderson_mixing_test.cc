#include "identification/maps/anderson_mixing.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

/// x = A x + b in three dimensions, which rounds in turn approach by 0.99 each: by hand the fixed point is
/// b / (1 - a), and an affine map of rank 3 is solved once four rounds are known.
TEST(AndersonMixing, SolvesAnAffineMapInAsManyRoundsAsItHasDirections) {
  const Eigen::Vector3d a(0.99, -0.5, 0.9), b(1, 2, 3);
  const Eigen::Vector3d fixed = b.cwiseQuotient(Eigen::Vector3d::Ones() - a);
  AndersonMixing mixing;
  Eigen::VectorXd x = Eigen::Vector3d::Zero();
  for (int round = 0; round < 4; ++round) x = mixing.Next(x, a.cwiseProduct(x) + b);
  // to what solving with columns of a condition around 1e4 leaves of 1e-16
  EXPECT_LT((x - fixed).norm(), 1e-9 * fixed.norm());
}

TEST(AndersonMixing, BeginsWithThePointItIsGiven) {
  AndersonMixing mixing;
  const Eigen::VectorXd x = Eigen::Vector2d(1, 2), g = Eigen::Vector2d(3, 5);
  EXPECT_EQ(mixing.Next(x, g), g);
}

}  // namespace
}  // namespace warmjoint
