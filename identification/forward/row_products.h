// Rows of a least-squares problem: a linear map of all of them, and the sums of their products.
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace warmjoint {

/// A transformation of a fit's rows before they are squared: the same linear map for each column of the
/// Jacobian and for the residual, over the kept samples in their order.
class RowTransform {
 public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  virtual ~RowTransform() = default;

  /// rows: [n x q], replaced by their images.
  virtual void Apply(Rows& rows) const = 0;
  /// n
  virtual Eigen::Index size() const = 0;

  Eigen::MatrixXd Of(const Eigen::MatrixXd& rows) const {
    Rows mapped = rows;
    Apply(mapped);
    return mapped;
  }
};

/// R^T R of the N rows of an R [N x p] that is never stored as a whole. It takes a block of rows at a time, so that each
/// product of two columns is a dot product over samples, with independent partial sums.
class RowProducts {
 public:
  /// p: columns
  explicit RowProducts(Eigen::Index p)
      : rows_(p <= kFew ? kBlock : kLargeBlock, p), sums_(Eigen::MatrixXd::Zero(p, p)) {}

  /// The next row to be filled; all its entries are to be set before the one after is asked for.
  auto Next() {
    if (count_ == rows_.rows()) TakeUp();
    return rows_.row(count_++);
  }

  /// R^T R of all rows so far. [p x p]
  Eigen::MatrixXd Sums() {
    TakeUp();
    return sums_.selfadjointView<Eigen::Upper>();
  }

 private:
  // columns up to which tiles are faster than products of matrices
  static constexpr Eigen::Index kFew = 16;
  static constexpr Eigen::Index kBlock = 128;        // rows: they stay in the nearest cache
  static constexpr Eigen::Index kLargeBlock = 1024;  // enough for products of matrices
  // why: nine sums of two and their six factors fill 16 registers; no result depends on it
  static constexpr Eigen::Index kTile = 3;  // columns

  void TakeUp() {
    if (rows_.cols() > kFew) {
      sums_.selfadjointView<Eigen::Upper>().rankUpdate(rows_.topRows(count_).transpose());
    } else {
      // where the number of rows is odd, a row of zeros follows
      if (count_ % 2 == 1) rows_.row(count_).setZero();
      for (Eigen::Index i = 0; i < rows_.cols(); i += kTile) {
        for (Eigen::Index j = i; j < rows_.cols(); j += kTile) AddTileAt(i, j);
      }
    }
    count_ = 0;
  }

  /// Products of the columns from i on with those from j on: of a tile, or of what is left of one.
  void AddTileAt(Eigen::Index i, Eigen::Index j) {
    const Eigen::Index p = std::min(kTile, rows_.cols() - i), q = std::min(kTile, rows_.cols() - j);
    // the first columns of a tile are whole, unless it is the last
    if (p == kTile && q == kTile) return AddTile<3, 3>(i, j);
    if (p == kTile && q == 2) return AddTile<3, 2>(i, j);
    if (p == kTile) return AddTile<3, 1>(i, j);
    if (p == 2) return AddTile<2, 2>(i, j);
    AddTile<1, 1>(i, j);
  }

  /// Sums of P by Q products that stay in registers, two rows at a time.
  template <int P, int Q>
  void AddTile(Eigen::Index i, Eigen::Index j) {
    using Two = Eigen::Array2d;
    Two sums[P][Q];
    for (auto& row : sums) {
      for (Two& one : row) one.setZero();
    }
    const double* first = rows_.data();
    for (Eigen::Index k = 0; k < count_; k += 2) {
      Two left[P], right[Q];
      for (int a = 0; a < P; ++a) left[a] = Eigen::Map<const Two>(first + (i + a) * kBlock + k);
      for (int b = 0; b < Q; ++b) right[b] = Eigen::Map<const Two>(first + (j + b) * kBlock + k);
      for (int a = 0; a < P; ++a) {
        for (int b = 0; b < Q; ++b) sums[a][b] += left[a] * right[b];
      }
    }
    for (int a = 0; a < P; ++a) {
      for (int b = 0; b < Q; ++b) sums_(i + a, j + b) += sums[a][b].sum();
    }
  }

  Eigen::MatrixXd rows_;
  Eigen::MatrixXd sums_;
  Eigen::Index count_ = 0;  // rows in the block
};

}  // namespace warmjoint
