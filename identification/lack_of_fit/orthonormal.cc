#include "identification/lack_of_fit/orthonormal.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "models/foundation/four.h"

namespace warmjoint {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

constexpr double kAsLong =
    1e-9;  // relative; why: rounding makes 1e-15 of it, nothing that is meant so little
constexpr double kShort = 0.1;  // why: what is left of a norm of 1 is free of the basis to 1e-15

/// Squares of what is left of the columns from `first` on, of which the first of the longest is looked for.
class Lengths {
 public:
  explicit Lengths(const MatrixXd& columns) : squares_(columns.colwise().squaredNorm()) {}

  Index Longest(const MatrixXd& columns, Index first) {
    // short columns are measured anew, since differences lose their length
    if (squares_.tail(columns.cols() - first).maxCoeff() < kShort * kShort) {
      squares_ = columns.colwise().squaredNorm();
    }
    Index longest = first;
    for (Index j = first + 1; j < squares_.size(); ++j) {
      if (squares_[j] > squares_[longest] * (1 + kAsLong)) longest = j;
    }
    return longest;
  }

  void Swap(Index i, Index j) { std::swap(squares_[i], squares_[j]); }

  /// shares: of the i-th column and of those after it
  template <typename Shares>
  void TakeOff(const Shares& shares) {
    squares_.tail(shares.size()) -= shares.cwiseAbs2();
  }

 private:
  Eigen::RowVectorXd squares_;
};

/// Subtracts from a column its projection on another one of norm 1; returns their product. Both [m].
WARMJOINT_FOR_EACH_PROCESSOR
double TakeOff(const double* basis, Index m, double* column) {
  // four rows at a time, and those that are left
  const Index fours = m - m % 4;
  Four sums = {}, one, other;
  for (Index i = 0; i < fours; i += 4) {
    Load(basis + i, one);
    Load(column + i, other);
    sums += one * other;
  }
  double product = SumOf(sums);
  for (Index i = fours; i < m; ++i) product += basis[i] * column[i];
  for (Index i = 0; i < fours; i += 4) {
    Load(basis + i, one);
    Load(column + i, other);
    Store(other - product * one, column + i);
  }
  for (Index i = fours; i < m; ++i) column[i] -= product * basis[i];
  return product;
}

}  // namespace

Basis Orthonormal(MatrixXd columns, double distinct) {
  // columns in the order in which they join: the basis in place of those that joined, and what is left of the others;
  // columns = basis R
  const Index q = columns.cols(), most = std::min(columns.rows(), q);
  MatrixXd R = MatrixXd::Zero(q, q);
  std::vector<Index> order(static_cast<std::size_t>(q));
  std::iota(order.begin(), order.end(), Index{0});
  Lengths lengths(columns);
  Index rank = 0;
  for (; rank < most; ++rank) {
    // the one of which most is left, while that is more than `distinct`
    const Index at = lengths.Longest(columns, rank);
    lengths.Swap(at, rank);
    columns.col(at).swap(columns.col(rank));
    R.col(at).swap(R.col(rank));
    std::swap(order[static_cast<std::size_t>(at)], order[static_cast<std::size_t>(rank)]);
    double norm = columns.col(rank).norm();
    if (norm < kShort) {
      const auto basis = columns.leftCols(rank);
      const Eigen::VectorXd again = basis.transpose() * columns.col(rank);
      columns.col(rank) -= basis * again;
      R.col(rank).head(rank) += again;
      norm = columns.col(rank).norm();
    }
    if (!(norm > distinct)) break;
    R(rank, rank) = norm;
    columns.col(rank) *= 1 / norm;

    for (Index j = rank + 1; j < q; ++j) {
      R(rank, j) = TakeOff(columns.col(rank).data(), columns.rows(), columns.col(j).data());
    }
    lengths.TakeOff(R.row(rank).tail(q - rank - 1));
  }

  // R^-1, its rows where the columns were; Eigen walks off a null pointer where there is nothing to solve
  MatrixXd r_inverse = MatrixXd::Zero(q, rank);
  if (rank > 0) {
    MatrixXd inverse = MatrixXd::Identity(rank, rank);
    R.topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solveInPlace(inverse);
    for (Index j = 0; j < rank; ++j) {
      r_inverse.row(order[static_cast<std::size_t>(j)]) = inverse.row(j);
    }
  }
  columns.conservativeResize(Eigen::NoChange, rank);
  return {std::move(columns), std::move(r_inverse)};
}

}  // namespace warmjoint
