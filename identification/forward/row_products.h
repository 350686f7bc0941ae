// Sums of products of rows that come one by one.
#pragma once

#include <Eigen/Core>

namespace warmjoint::inline identification {

/// R^T R of the N rows of an R [N x P] that is never held: a block of rows at a time, so that each
/// product of two columns is a dot product over samples, with independent partial sums.
/// P: columns, or Eigen::Dynamic.
template <int P>
class RowProducts {
 public:
  using Square = Eigen::Matrix<double, P, P>;

  /// p: columns, as P where that is known.
  explicit RowProducts(Eigen::Index p) : rows_(kBlock, p), sums_(Square::Zero(p, p)) {}

  /// A row to be filled: its entry i is row[i].
  class Row {
   public:
    explicit Row(double* first) : first_(first) {}
    double& operator[](Eigen::Index i) const { return first_[i * kBlock]; }

   private:
    double* first_;
  };

  /// The next row; all its entries are to be set before the one after is asked for.
  Row Next() {
    if (count_ == kBlock) TakeUp();
    return Row(rows_.data() + count_++);
  }

  /// R^T R of all rows so far. [P x P]
  Square Sums() {
    TakeUp();
    return sums_.template selfadjointView<Eigen::Upper>();
  }

 private:
  static constexpr Eigen::Index kBlock = 128;  // rows: they stay in the nearest cache

  void TakeUp() {
    const auto rows = rows_.topRows(count_);
    if constexpr (P == Eigen::Dynamic) {
      sums_.template selfadjointView<Eigen::Upper>().rankUpdate(rows.transpose());
    } else {
      for (Eigen::Index j = 0; j < P; ++j) {
        for (Eigen::Index i = 0; i <= j; ++i) sums_(i, j) += rows.col(i).dot(rows.col(j));
      }
    }
    count_ = 0;
  }

  Eigen::Matrix<double, kBlock, P> rows_;
  Square sums_;
  Eigen::Index count_ = 0;  // rows in the block
};

}  // namespace warmjoint::inline identification
