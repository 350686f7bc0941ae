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

/// R^T R of the N rows of an R [N x P] that is never stored as a whole. It takes a block of rows at a time, so that each
/// product of two columns is a dot product over samples, with independent partial sums.
/// P: columns, or Eigen::Dynamic.
template <int P>
class RowProducts {
 public:
  using Square = Eigen::Matrix<double, P, P>;

  /// p: columns, as P where that is known.
  explicit RowProducts(Eigen::Index p) : rows_(kBlock, p), sums_(Square::Zero(p, p)) {}

  /// The next row to be filled; all its entries are to be set before the one after is asked for.
  auto Next() {
    if (count_ == kBlock) TakeUp();
    return rows_.row(count_++);
  }

  /// R^T R of all rows so far. [P x P]
  Square Sums() {
    TakeUp();
    return sums_.template selfadjointView<Eigen::Upper>();
  }

 private:
  static constexpr Eigen::Index kBlock = 128;  // rows: they stay in the nearest cache
  // why: nine sums of two and their six factors fill 16 registers; no result depends on it
  static constexpr int kTile = 3;  // columns

  void TakeUp() {
    if constexpr (P == Eigen::Dynamic) {
      const auto rows = rows_.topRows(count_);
      sums_.template selfadjointView<Eigen::Upper>().rankUpdate(rows.transpose());
    } else {
      AddTiles<0, 0>();
    }
    count_ = 0;
  }

  /// Products of columns I.. with columns J.., and of all tiles after these: the upper triangle.
  template <int I, int J>
  void AddTiles() {
    AddTile<I, J>();
    if constexpr (I + kTile <= J) {
      AddTiles<I + kTile, J>();
    } else if constexpr (J + kTile < P) {
      AddTiles<0, J + kTile>();
    }
  }

  /// Sums of up to kTile by kTile products that stay in registers, two rows at a time.
  template <int I, int J>
  void AddTile() {
    using Two = Eigen::Array2d;
    constexpr int p = std::min(kTile, P - I), q = std::min(kTile, P - J);
    Two sums[p][q];
    for (int i = 0; i < p; ++i) {
      for (int j = 0; j < q; ++j) sums[i][j].setZero();
    }
    // where the number of rows is odd, a row of zeros follows
    if (count_ % 2 == 1) rows_.row(count_).setZero();
    const double* first = rows_.data();
    for (Eigen::Index k = 0; k < count_; k += 2) {
      Two left[p], right[q];
      for (int i = 0; i < p; ++i) left[i] = Eigen::Map<const Two>(first + (I + i) * kBlock + k);
      for (int j = 0; j < q; ++j) right[j] = Eigen::Map<const Two>(first + (J + j) * kBlock + k);
      for (int i = 0; i < p; ++i) {
        for (int j = 0; j < q; ++j) {
          if (I + i <= J + j) sums[i][j] += left[i] * right[j];
        }
      }
    }
    for (int i = 0; i < p; ++i) {
      for (int j = 0; j < q; ++j) {
        if (I + i <= J + j) sums_(I + i, J + j) += sums[i][j].sum();
      }
    }
  }

  Eigen::Matrix<double, kBlock, P> rows_;
  Square sums_;
  Eigen::Index count_ = 0;  // rows in the block
};

}  // namespace warmjoint
