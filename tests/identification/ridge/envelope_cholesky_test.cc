#include "identification/ridge/envelope_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

/// A positive semidefinite matrix whose entries are 0 beyond `reach` from the diagonal of a circle
/// of n, its rows and columns put into a drawn order.
Eigen::MatrixXd ScrambledCircle(Eigen::Index n, Eigen::Index reach) {
  RandomStream random({7, 0}, Stream::motion);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(4 * n, n);
  for (Eigen::Index i = 0; i < 4 * n; ++i) {
    for (Eigen::Index k = 0; k <= reach; ++k) rows(i, (i / 4 + k) % n) = random.Normal();
  }
  std::vector<Eigen::Index> order(static_cast<size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) order[i] = i * 7 % n;  // n has no factor 7
  const Eigen::MatrixXd gram = rows.transpose() * rows;
  return gram(order, order);
}

TEST(EnvelopeCholesky, SolvesLikeADenseFactorisation) {
  for (const auto& [n, reach] : {std::pair(1, 0), std::pair(50, 1), std::pair(200, 5),
                                 std::pair(200, 40), std::pair(130, 129)}) {
    const Eigen::MatrixXd matrix = ScrambledCircle(n, reach);
    const Eigen::MatrixXd right = Eigen::MatrixXd::Identity(n, 3);
    EnvelopeCholesky factors(matrix);
    for (const double shift : {1e-3, 1.0, 100.0}) {
      ASSERT_TRUE(factors.Factor(shift));
      const Eigen::MatrixXd expected =
          (matrix + shift * Eigen::MatrixXd::Identity(n, n)).llt().solve(right);
      // 1e-9: two linear solves of condition at most 1e6
      EXPECT_LE((factors.Solve(right) - expected).norm(), 1e-9 * expected.norm()) << n;
    }
  }
}

TEST(EnvelopeCholesky, KeepsToWhatIsNotZero) {
  // on a circle each column has at most the neighbours of both ways round, 2 reach on each side
  EXPECT_LE(EnvelopeCholesky(ScrambledCircle(200, 5)).size(), 200 * (4 * 5 + 1));
  // blocks that do not meet stay apart
  Eigen::MatrixXd blocks = Eigen::MatrixXd::Identity(100, 100);
  blocks(0, 99) = blocks(99, 0) = 0.5;
  EXPECT_EQ(EnvelopeCholesky(blocks).size(), 101);
}

TEST(EnvelopeCholesky, SaysWhereThereIsNoFactor) {
  EXPECT_FALSE(EnvelopeCholesky(-Eigen::MatrixXd::Identity(60, 60)).Factor(0.5));
}

}  // namespace
}  // namespace warmjoint
