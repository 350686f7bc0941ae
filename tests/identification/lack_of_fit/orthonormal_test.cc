#include "identification/lack_of_fit/orthonormal.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Columns of norm 1, the last a mix of two others but for `apart`.
MatrixXd Columns(Index rows, Index count, double apart, std::uint64_t seed) {
  RandomStream random({seed, 0}, Stream::test);
  MatrixXd columns = MatrixXd::NullaryExpr(rows, count, [&] { return random.Normal(); });
  columns.colwise().normalize();
  const Eigen::VectorXd own = columns.col(count - 1);
  columns.col(count - 1) = columns.col(0) + 2 * columns.col(1) + apart * own;
  columns.colwise().normalize();
  return columns;
}

/// The largest entry of basis^T basis - 1.
double Skewness(const MatrixXd& basis) {
  return (basis.transpose() * basis - MatrixXd::Identity(basis.cols(), basis.cols()))
      .lpNorm<Eigen::Infinity>();
}

/// What of the columns a basis does not hold, the longest column of it.
double LeftOut(const MatrixXd& basis, const MatrixXd& columns) {
  return (columns - basis * (basis.transpose() * columns)).colwise().norm().maxCoeff();
}

TEST(Orthonormal, HoldsWhatStandsOut) {
  for (const double apart : {1.0, 0.1, 1e-3, 1e-5, 1e-7, 1e-12}) {
    const MatrixXd columns = Columns(300, 6, apart, 1);
    const Basis basis = Orthonormal(columns, 1e-9);
    // the last column has about `apart` over the length of the mix, 2.2, beside the others
    EXPECT_EQ(basis.basis.cols(), apart > 1e-8 ? 6 : 5) << apart;
    // 1e-9: what rounding, 1e-16, becomes by columns that are made of 1e-7 of what they were
    EXPECT_LT(LeftOut(basis.basis, columns), 1e-9) << apart;
    // rounding of 300 rows, 1e-15, over what the shortest column that joined has of its own, apart / 2.2
    const double own = apart > 1e-8 ? apart / 2.2 : 1;
    EXPECT_LT((columns * basis.mix - basis.basis).lpNorm<Eigen::Infinity>(), 1e-15 / own + 1e-12)
        << apart;
    // rounding of 300 rows
    EXPECT_LT(Skewness(basis.basis), 1e-13) << apart;
    // and how the columns are made of it
    EXPECT_LT((basis.basis * basis.held - columns).colwise().norm().maxCoeff(), 1e-9) << apart;
  }
}

TEST(Orthonormal, SpansWhatHouseholderSpans) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const MatrixXd columns = Columns(200, 8, 0.3, seed);
    const Eigen::HouseholderQR<MatrixXd> qr(columns);
    const MatrixXd Q = qr.householderQ() * MatrixXd::Identity(200, 8);
    const MatrixXd basis = Orthonormal(columns, 0.02).basis;
    ASSERT_EQ(basis.cols(), 8);
    // projections onto one space: 1e-12 for rounding over the least column's square, 0.01
    EXPECT_LT((Q * Q.transpose() - basis * basis.transpose()).lpNorm<Eigen::Infinity>(), 1e-12);
  }
}

TEST(Orthonormal, LeavesOutWhatIsTooMuchAlike) {
  const MatrixXd columns = Columns(100, 4, 0.01, 2);
  EXPECT_EQ(Orthonormal(columns, 0.02).basis.cols(), 3);
  EXPECT_EQ(MixOfDistinct(columns.transpose() * columns, 0.02).cols(), 3);
  EXPECT_EQ(Orthonormal(columns, 0.001).basis.cols(), 4);
  EXPECT_EQ(Orthonormal(MatrixXd::Zero(100, 2), 0.02).basis.cols(), 0);
  EXPECT_EQ(Orthonormal(MatrixXd(100, 0), 0.02).mix.rows(), 0);
  // more columns than rows
  EXPECT_EQ(Orthonormal(Columns(3, 5, 1, 1), 1e-9).basis.cols(), 3);
}

TEST(Orthonormal, ChoosesAlikeWhateverRoundingDoes) {
  // all columns are as long: the order is theirs, also when each is 1e-14 longer or shorter
  const MatrixXd columns = Columns(300, 6, 0.03, 5);
  const Eigen::RowVectorXd factors =
      (Eigen::RowVectorXd(6) << 1, 1 + 1e-14, 1 - 1e-14, 1, 1 + 1e-14, 1).finished();
  const MatrixXd scaled = columns * factors.asDiagonal();
  const MatrixXd mix = MixOfDistinct(columns.transpose() * columns, 0.02);
  const MatrixXd other = MixOfDistinct(scaled.transpose() * scaled, 0.02);
  ASSERT_EQ(mix.cols(), other.cols());
  // 1e-10: 1e-14 over the square of the shortest column, 4e-4
  EXPECT_LT((mix - other).lpNorm<Eigen::Infinity>(), 1e-10 * mix.lpNorm<Eigen::Infinity>());
}

TEST(Orthonormal, LeavesOutTheLastOfThoseThatDependOnEachOther) {
  // three of norm 1 in one plane, whose sum is 0: beside the first the others are as long
  MatrixXd columns = Columns(300, 3, 1, 6);
  const Eigen::VectorXd first = columns.col(0);
  const Eigen::VectorXd beside =
      (columns.col(1) - first.dot(columns.col(1)) * first).normalized() * std::sqrt(0.75);
  columns.col(1) = -0.5 * first + beside;
  columns.col(2) = -0.5 * first - beside;
  for (const double longer : {1 - 1e-14, 1.0, 1 + 1e-14}) {
    const Basis basis = Orthonormal(columns * Eigen::RowVector3d(1, 1, longer).asDiagonal(), 1e-9);
    ASSERT_EQ(basis.mix.cols(), 2);
    EXPECT_EQ(basis.mix.row(2).norm(), 0) << longer;
    // the plane's other column by the two that joined: 1e-13 for rounding of 300 rows
    EXPECT_LT((basis.basis * basis.held - columns).colwise().norm().maxCoeff(), 1e-13) << longer;
  }
}

}  // namespace
}  // namespace warmjoint
