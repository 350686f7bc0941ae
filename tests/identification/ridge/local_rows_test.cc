#include "identification/ridge/local_rows.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <numbers>

#include "identification/ridge/local_ridge.h"
#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

/// Maps of every kind of axis and factor: 24 x 4 kernels, 12 x 3 on a circle, 5.
std::vector<FrictionMap> AllKinds(KernelKind kind) {
  return {{{{MapQuantity::position, EvenAxis(-1, 1, 24)},
            {MapQuantity::velocity, SpeedAxis(0.2, 1, 2)}},
           kind,
           {}},
          {{{MapQuantity::motor_position, CircleAxis(2 * std::numbers::pi, 12)},
            {MapQuantity::energy, EvenAxis(-2, 0, 3)}},
           kind,
           {},
           MapFactor::direction},
          {{{MapQuantity::load, EvenAxis(0, 3, 5)}}, kind, {}, MapFactor::velocity}};
}

MapPoints DrawnPoints(Eigen::Index n) {
  RandomStream random({3, 0}, Stream::motion);
  MapPoints points(n, 5);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double p = random.Uniform(-1.2, 1.2);
    points.row(i) << p, 100 * p, random.Uniform(-1, 1), random.Uniform(-2, 0), random.Uniform(0, 3);
  }
  points(0, 2) = 0;    // at rest: kernels on either side of v = 0 have none
  points(1, 0) = 1e3;  // far from every centre
  return points;
}

/// The same rows by EvaluateMap: a weight of 1 on one kernel gives that kernel.
Eigen::MatrixXd DenseRows(std::vector<FrictionMap> maps, const MapPoints& points) {
  Eigen::MatrixXd rows(points.rows(), KernelCount(maps));
  Eigen::Index column = 0;
  for (FrictionMap& map : maps) {
    for (size_t k = 0; k < map.size(); ++k, ++column) {
      map.weights.assign(map.size(), 0);
      map.weights[k] = 1;
      for (Eigen::Index i = 0; i < points.rows(); ++i) {
        rows(i, column) = EvaluateMap(map, PointAt(points, i));
      }
    }
  }
  return rows;
}

class LocalRows : public ::testing::TestWithParam<KernelKind> {
 protected:
  const std::vector<FrictionMap> maps_ = AllKinds(GetParam());
  const MapPoints points_ = DrawnPoints(900);
  const Eigen::MatrixXd kernels_ = DenseRows(maps_, points_);
  const Eigen::MatrixXd free_ = points_.middleCols(2, 1);
  const Eigen::VectorXd y_ = points_.col(0).array().sin() + points_.col(3).array();
};

TEST_P(LocalRows, HoldEveryKernelOfEverySampleOnce) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(kernels_.rows(), kernels_.cols());
  for (const RowGroup& group : GroupRows(maps_, points_, 100, 900)) {
    for (size_t i = 0; i < group.samples.size(); ++i) {
      for (size_t k = 0; k < group.kernels.size(); ++k) {
        rows(group.samples[i], group.kernels[k]) += group.values(i, k);
      }
    }
  }
  // what a prepared axis leaves out is below 3e-13 of the largest kernel, so that sums change by no more than
  // 1e-12 (prepared_map.h), and no kernel exceeds 1
  EXPECT_LE((rows - kernels_).bottomRows(800).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(rows.topRows(100).norm(), 0);
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
  EXPECT_EQ(CrossValidate(parts, 1, strengths, 1), CrossValidate(parts, 1, strengths, 4));
}

INSTANTIATE_TEST_SUITE_P(Kernels, LocalRows,
                         ::testing::Values(KernelKind::plain, KernelKind::normalised),
                         [](const auto& kind) {
                           return kind.param == KernelKind::plain ? "plain" : "normalised";
                         });

}  // namespace
}  // namespace warmjoint
