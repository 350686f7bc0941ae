// The solver: what it does where squares, product or steps are no numbers.
#include "identification/model/minimise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// (x - 3)^2 + (y + 1)^2, with what `spoil` makes of its sums.
template <class Spoil>
SquaresProblem Bowl(Spoil spoil) {
  return {.sums = [=](const VectorXd& x) {
    const VectorXd rest = Eigen::Vector2d(3, -1) - x;
    RowSums sums{MatrixXd::Identity(2, 2), rest, rest.squaredNorm()};
    spoil(x, sums);
    return sums;
  }};
}

TEST(Minimise, ArrivesWhereAllIsFinite) {
  const Minimum found = Minimise(Bowl([](const VectorXd&, RowSums&) {}), VectorXd::Zero(2));
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.x[0], 3, 1e-9);
}

TEST(Minimise, TakesTheLastStepThoughSquaresAreFlatToRounding) {
  // squares of 1e6 in addition to those of the bowl: 1e-6 beside its bottom they do not tell up from down
  const auto beside = [](const VectorXd& x, RowSums& sums) {
    sums.squares += 1e6 + (x[0] == 3 ? 1e-9 : 0);
  };
  const Minimum found = Minimise(Bowl(beside), Eigen::Vector2d(3 + 1e-6, -1));
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.x[0], 3, 1e-12);
}

TEST(Minimise, LeavesUnknownsExactlyAtTheirBounds) {
  // squares about points of which one coordinate lies below its bound, with unknowns of all scales
  RandomStream random({5, 0}, Stream::test);
  for (int trial = 0; trial < 200; ++trial) {
    MatrixXd rows(8, 5);
    for (double& one : rows.reshaped()) one = random.Normal();
    for (int i = 0; i < 5; ++i) rows.col(i) *= std::pow(10, 6 * random.Uniform() - 3);
    const MatrixXd gram = rows.transpose() * rows;
    VectorXd free(5);
    for (double& one : free) one = random.Normal();
    free[2] = -1 / rows.col(2).norm();
    SquaresProblem problem{.sums = [&](const VectorXd& x) {
      const VectorXd left = free - x;
      return RowSums{gram, gram * left, left.dot(gram * left)};
    }};
    problem.lower = VectorXd::Constant(5, -1e9);
    problem.upper = VectorXd::Constant(5, 1e9);
    problem.lower[2] = 0;
    VectorXd start = free;
    start[2] = 0;
    const Minimum found = Minimise(problem, start);
    ASSERT_TRUE(found.converged) << trial;
    ASSERT_EQ(found.x[2], 0) << trial;
    ASSERT_EQ(found.at_bound, std::vector<Eigen::Index>{2}) << trial;
  }
}

TEST(Minimise, HasNotConvergedOnWhatIsNoNumber) {
  const auto ends = [](auto spoil) {
    for (const double start : {0.0, 3.0}) {
      SquaresProblem problem = Bowl(spoil);
      EXPECT_FALSE(Minimise(problem, Eigen::Vector2d(start, -1)).converged) << start;
      // nor where limits would make a number of a step that is none, or the squares are as small as rounding
      problem.largest_step = VectorXd::Ones(2);
      problem.lower = VectorXd::Constant(2, -10);
      problem.upper = VectorXd::Constant(2, 10);
      problem.least = 100;
      EXPECT_FALSE(Minimise(problem, Eigen::Vector2d(start, -1)).converged) << start;
    }
  };
  ends([](const VectorXd&, RowSums& sums) { sums.product[0] = kNaN; });
  ends([](const VectorXd&, RowSums& sums) { sums.gram(1, 1) = kNaN; });
  ends([](const VectorXd&, RowSums& sums) { sums.squares = kNaN; });
}

TEST(Minimise, TakesNoPointWithoutANumber) {
  // the derivatives end at x = 2, the squares go on
  const auto ends = [](const VectorXd& x, RowSums& sums) {
    if (x[0] > 2) sums.product[0] = kNaN;
  };
  const Minimum found = Minimise(Bowl(ends), VectorXd::Zero(2));
  EXPECT_FALSE(found.converged);
  EXPECT_TRUE(found.x.allFinite());
  EXPECT_TRUE(found.sums.product.allFinite());
  EXPECT_LT(found.sums.squares, 10);
}

TEST(Minimise, EndsWhereAStepIsNoNumber) {
  SquaresProblem problem = Bowl([](const VectorXd&, RowSums&) {});
  problem.step = [](const MatrixXd&, const VectorXd&, const VectorXd&) {
    return VectorXd::Constant(2, kNaN);
  };
  const Minimum found = Minimise(problem, VectorXd::Zero(2));
  EXPECT_FALSE(found.converged);
  EXPECT_EQ(found.x, VectorXd::Zero(2));
}

}  // namespace
}  // namespace warmjoint
