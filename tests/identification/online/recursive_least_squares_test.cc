#include "identification/online/recursive_least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

TEST(RecursiveLeastSquares, EqualsWeightedLeastSquaresInOneGo) {
  RandomStream random({5, 0}, Stream::test);
  Eigen::Matrix<double, 300, 3> A;
  Eigen::Matrix<double, 300, 1> y;
  for (int i = 0; i < 300; ++i) {
    A.row(i) << 1, random.Normal(), random.Normal();
    y[i] = 2 + 3 * A(i, 1) - A(i, 2) + random.Normal();
  }
  for (const double forgetting : {1.0, 0.97}) {
    auto state = KnowNothing<3>(3, 1e8);
    for (int i = 0; i < 300; ++i) TakeIn<3>(A.row(i).transpose(), y[i], forgetting, state);

    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (int i = 0; i < 300; ++i) {
      const double weight = std::pow(forgetting, 299 - i);
      normal += weight * A.row(i).transpose() * A.row(i);
      right += weight * A.row(i).transpose() * y[i];
    }
    const Eigen::Vector3d expected = normal.ldlt().solve(right);
    // 1e-7: the doubt of 1e8 counts as 1e-8 samples, beside at least 30
    EXPECT_LT((state.estimate - expected).norm(), 1e-7) << forgetting;
    EXPECT_LT((state.cofactor * normal - Eigen::Matrix3d::Identity()).norm(), 1e-6) << forgetting;
    EXPECT_EQ(state.cofactor, state.cofactor.transpose().eval());
  }
}

}  // namespace
}  // namespace warmjoint
