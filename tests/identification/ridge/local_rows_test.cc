#include "identification/ridge/local_rows.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "identification/ridge/local_ridge.h"
#include "tests/support/cross_validate.h"
#include "tests/support/maps_of_every_kind.h"

namespace warmjoint {
namespace {

class LocalRows : public ::testing::TestWithParam<KernelKind> {
 protected:
  const std::vector<FrictionMap> maps_ = test::MapsOfEveryKind(GetParam());
  const MapPoints points_ = test::DrawnPoints(900);
  const Eigen::MatrixXd kernels_ = test::DenseRows(maps_, points_);
  const Eigen::MatrixXd free_ = points_.middleCols(2, 1);
  const Eigen::VectorXd y_ = points_.col(0).array().sin() + points_.col(3).array();
};

TEST_P(LocalRows, GiveTheProductsOfTheDenseRows) {
  const Eigen::VectorXd expected = kernels_.transpose() * y_;
  // what a prepared axis leaves out, of 900 samples of about 1
  EXPECT_LE((LocalProducts(maps_, points_, y_) - expected).cwiseAbs().maxCoeff(), 900 * 1e-12);
  Eigen::MatrixXd both(y_.size(), 2);
  both << y_, 2 * y_;
  const Eigen::MatrixXd products = LocalProducts(maps_, points_, both);
  EXPECT_LE((products.col(1) - 2 * expected).cwiseAbs().maxCoeff(), 2 * 900 * 1e-12);
}

TEST_P(LocalRows, GiveTheNormalEquationsOfTheDenseRows) {
  Eigen::MatrixXd A(kernels_.rows(), 1 + kernels_.cols());
  A << free_, kernels_;
  NormalEquations expected(A.cols());
  expected.Add(A, y_);
  const NormalEquations normal = LocalNormal(maps_, points_, free_, y_, 0, 400)
                                     .Plus(LocalNormal(maps_, points_, free_, y_, 400, 900));
  // 1e-12: sums in another order
  EXPECT_LE((normal.gram - expected.gram).norm(), 1e-12 * expected.gram.norm());
  EXPECT_LE((normal.product - expected.product).norm(), 1e-12 * expected.product.norm());
  EXPECT_NEAR(normal.squares, expected.squares, 1e-12 * expected.squares);
  EXPECT_EQ(normal.rows, 900);
}

TEST_P(LocalRows, AreSolvedAsByTheDenseSolver) {
  const NormalEquations normal = LocalNormal(maps_, points_, free_, y_, 0, 900);
  LocalRidge local(normal, 1);
  for (const double strength : {1e-3, 1e-1, 10.0, 1e4}) {
    Eigen::MatrixXd gram = normal.gram;
    gram.diagonal().tail(gram.rows() - 1).array() += strength;
    const Eigen::VectorXd expected = gram.llt().solve(normal.product);
    const auto x = local.Solve(strength);
    ASSERT_TRUE(x);
    // the promise of the family: exact to 1e-8 against a dense solver
    EXPECT_LE((*x - expected).norm(), 1e-8 * expected.norm()) << strength;
  }
}

TEST_P(LocalRows, CrossValidateAlikeOnAnyNumberOfThreads) {
  std::vector<NormalEquations> parts;
  for (Eigen::Index i = 0; i < 3; ++i) {
    parts.push_back(LocalNormal(maps_, points_, free_, y_, 300 * i, 300 * (i + 1)));
  }
  const std::vector<double> strengths{0.01, 1, 100};
  EXPECT_EQ(test::CrossValidate(parts, 1, strengths, 1),
            test::CrossValidate(parts, 1, strengths, 4));
}

INSTANTIATE_TEST_SUITE_P(Kernels, LocalRows,
                         ::testing::Values(KernelKind::plain, KernelKind::normalised),
                         [](const auto& kind) {
                           return kind.param == KernelKind::plain ? "plain" : "normalised";
                         });

}  // namespace
}  // namespace warmjoint
