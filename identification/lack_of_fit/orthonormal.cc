#include "identification/lack_of_fit/orthonormal.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <vector>

#include "identification/lack_of_fit/column_products.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kAsLong =
    1e-9;  // relative; why: rounding makes 1e-15 of it, nothing that is meant so little
constexpr double kSeenByProducts =
    1e-6;  // of a column's square; why: a basis made of such ones is orthonormal to 1e-16 of it, 1e-10

constexpr double kSureByProducts =
    1e-2;  // of a column's square; why: a basis made of such ones is orthonormal to 1e-14

/// The inverse of the leading rank x rank of a triangular R.
MatrixXd InverseOf(const MatrixXd& R, Index rank) {
  return R.topLeftCorner(rank, rank)
      .triangularView<Eigen::Upper>()
      .solve(MatrixXd::Identity(rank, rank));
}

/// Cholesky's factor of products, as many rows as columns stand out, and the order in which they joined.
struct Factor {
  MatrixXd root;             // [q x q] R, of the columns in their order
  std::vector<Index> order;  // [q]
  Index rank = 0;
  double least = 1;  // square of what the last column to join had beside those before it
};

/// Where in the order the column stands of which most is left. Of those that are as long up to rounding it is the
/// first, so that rounding decides nothing. squares: [q] of what is left
Index Longest(const Eigen::VectorXd& squares, const std::vector<Index>& order, Index rank) {
  const auto left = [&](Index place) { return squares[order[static_cast<size_t>(place)]]; };
  Index longest = rank;
  for (Index place = rank + 1; place < squares.size(); ++place) {
    if (left(place) > left(longest) * (1 + kAsLong)) longest = place;
  }
  return longest;
}

/// The factor of q columns none of which has joined.
Factor Unfactored(Index q) {
  Factor factor{MatrixXd::Zero(q, q), std::vector<Index>(static_cast<size_t>(q)), 0, 1};
  std::iota(factor.order.begin(), factor.order.end(), Index{0});
  return factor;
}

/// Lets the column at a place of the order join next.
void LetJoin(Index at, Factor& factor) {
  factor.root.col(at).swap(factor.root.col(factor.rank));
  std::swap(factor.order[static_cast<size_t>(factor.rank)], factor.order[static_cast<size_t>(at)]);
}

/// products: [q x q] of the columns
Factor FactorOf(MatrixXd products, Index most, double distinct) {
  const Index q = products.rows();
  Factor factor = Unfactored(q);
  auto& [root, order, rank, least] = factor;
  for (; rank < most; ++rank) {
    // the column of which most is left, while that stands out
    const Index at = Longest(products.diagonal(), order, rank);
    const Index pivot = order[static_cast<size_t>(at)];
    const double square = products(pivot, pivot);
    if (!(square > distinct * distinct)) break;
    least = square;
    LetJoin(at, factor);

    // its row of R, and what the others have beside it
    const double norm = std::sqrt(square);
    root(rank, rank) = norm;
    for (Index j = rank + 1; j < q; ++j) {
      const Index column = order[static_cast<size_t>(j)];
      root(rank, j) = products(column, pivot) / norm;
      for (Index i = rank + 1; i <= j; ++i) {
        const Index row = order[static_cast<size_t>(i)];
        products(column, row) -= root(rank, i) * root(rank, j);
        products(row, column) = products(column, row);
      }
    }
  }
  return factor;
}

/// R^-1 with the order of the columns turned back. [q x rank]
MatrixXd MixOf(const Factor& factor) {
  MatrixXd mix = MatrixXd::Zero(factor.root.rows(), factor.rank);
  // Eigen walks off a null pointer where there is nothing to multiply
  if (factor.rank == 0) return mix;
  const MatrixXd inverse = InverseOf(factor.root, factor.rank);
  for (Index j = 0; j < factor.rank; ++j) {
    mix.row(factor.order[static_cast<size_t>(j)]) = inverse.row(j);
  }
  return mix;
}

/// R with the order of the columns turned back. [rank x q]
MatrixXd HeldOf(const Factor& factor) {
  MatrixXd held(factor.rank, factor.root.cols());
  for (Index j = 0; j < held.cols(); ++j) {
    held.col(factor.order[static_cast<size_t>(j)]) = factor.root.col(j).head(factor.rank);
  }
  return held;
}

/// By Gram's and Schmidt's method, each column freed once more of all before it as it joins, which tells columns apart
/// that differ by as little as rounding.
Basis ByTakingOff(const MatrixXd& columns, double distinct) {
  const Index q = columns.cols(), most = std::min(columns.rows(), q);
  Factor factor = Unfactored(q);
  auto& [root, order, rank, least] = factor;
  MatrixXd left = columns, basis(columns.rows(), most);
  for (; rank < most; ++rank) {
    // the column of which most is left, while that stands out
    const Index at = Longest(left.colwise().squaredNorm().transpose(), order, rank);
    const Index pivot = order[static_cast<size_t>(at)];
    LetJoin(at, factor);
    const Eigen::VectorXd again = basis.leftCols(rank).transpose() * left.col(pivot);
    left.col(pivot) -= basis.leftCols(rank) * again;
    root.col(rank).head(rank) += again;
    const double norm = left.col(pivot).norm();
    if (!(norm > distinct)) break;
    root(rank, rank) = norm;
    basis.col(rank) = left.col(pivot) / norm;

    // what the others share with it is taken off them
    for (Index j = rank + 1; j < q; ++j) {
      auto other = left.col(order[static_cast<size_t>(j)]);
      root(rank, j) = basis.col(rank).dot(other);
      other -= root(rank, j) * basis.col(rank);
    }
  }
  return {basis.leftCols(rank), MixOf(factor), HeldOf(factor)};
}

/// From the products of columns. factor: of those
Basis ByProducts(const MatrixXd& columns, const Factor& factor) {
  Basis result{MatrixXd(columns.rows(), factor.rank), MixOf(factor), HeldOf(factor)};
  for (Index j = 0; j < factor.rank; ++j) {
    // of the column that joined, and of those before it
    const auto own = result.mix.col(j);
    const Index joined = factor.order[static_cast<size_t>(j)];
    result.basis.col(j) = own[joined] * columns.col(joined);
    for (Index k = 0; k < j; ++k) {
      const Index before = factor.order[static_cast<size_t>(k)];
      result.basis.col(j) += own[before] * columns.col(before);
    }
  }
  return result;
}

}  // namespace

Basis Orthonormal(const MatrixXd& columns, double distinct) {
  const Factor factor =
      FactorOf(ProductsOf(columns), std::min(columns.cols(), columns.rows()), distinct);
  // products lose what is left of a column to rounding once it is short
  const bool told =
      factor.least > kSeenByProducts && (distinct * distinct > kSeenByProducts ||
                                         factor.rank == std::min(columns.cols(), columns.rows()));
  if (!told) return ByTakingOff(columns, distinct);
  Basis result = ByProducts(columns, factor);
  if (factor.least > kSureByProducts) return result;
  // short columns leave a basis that is orthonormal nearly: once more makes it so to rounding
  Basis again = ByProducts(result.basis, FactorOf(ProductsOf(result.basis), factor.rank, 0));
  again.mix = result.mix * again.mix;
  again.held *= result.held;
  return again;
}

MatrixXd MixOfDistinct(const MatrixXd& products, double distinct) {
  assert(distinct * distinct > kSeenByProducts);
  return MixOf(FactorOf(products, products.cols(), distinct));
}

}  // namespace warmjoint
