#include "identification/lack_of_fit/orthonormal.h"

#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <vector>

#include "identification/lack_of_fit/column_products.h"

namespace warmjoint::inline identification {
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
/// first, so that rounding decides nothing. products: [q x q] of what is left
Index Longest(const MatrixXd& products, const std::vector<Index>& order, Index rank) {
  const auto left = [&](Index place) {
    const Index column = order[static_cast<size_t>(place)];
    return products(column, column);
  };
  Index longest = rank;
  for (Index place = rank + 1; place < products.rows(); ++place) {
    if (left(place) > left(longest) * (1 + kAsLong)) longest = place;
  }
  return longest;
}

/// products: [q x q] of the columns
Factor FactorOf(MatrixXd products, Index most, double distinct) {
  const Index q = products.rows();
  Factor factor{MatrixXd::Zero(q, q), std::vector<Index>(static_cast<size_t>(q)), 0, 1};
  auto& [root, order, rank, least] = factor;
  std::iota(order.begin(), order.end(), Index{0});
  for (; rank < most; ++rank) {
    // the column of which most is left, while that stands out
    const Index at = Longest(products, order, rank);
    const Index pivot = order[static_cast<size_t>(at)];
    const double square = products(pivot, pivot);
    if (!(square > distinct * distinct)) break;
    least = square;
    root.col(at).swap(root.col(rank));
    std::swap(order[static_cast<size_t>(rank)], order[static_cast<size_t>(at)]);

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

/// By Householder's method, which tells columns apart that differ by as little as rounding.
Basis ByHouseholder(const MatrixXd& columns, double distinct) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(columns);
  // as many columns count as stand out beside those before them
  const Index q = columns.cols(), most = std::min(columns.rows(), q);
  const Index rank = (qr.matrixQR().diagonal().head(most).array().abs() > distinct).count();
  if (rank == 0) return {MatrixXd(columns.rows(), 0), MatrixXd(q, 0), MatrixXd(0, q)};
  // Q, the mix of columns that makes it, R^-1 with their order turned back, and R, which makes them of it
  Basis result;
  result.basis = qr.householderQ() * MatrixXd::Identity(columns.rows(), rank);
  MatrixXd inverse = MatrixXd::Zero(q, rank);
  inverse.topRows(rank) = InverseOf(qr.matrixQR(), rank);
  result.mix = qr.colsPermutation() * inverse;
  const MatrixXd root = qr.matrixQR().topRows(rank).triangularView<Eigen::Upper>();
  result.held = root * qr.colsPermutation().transpose();
  return result;
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
  if (!told) return ByHouseholder(columns, distinct);
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

}  // namespace warmjoint::inline identification
