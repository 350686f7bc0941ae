// Products of columns with each other, over some of their rows.
#pragma once

#include <Eigen/Core>

namespace warmjoint::inline identification {

/// Products of A columns from the i-th on with B columns from the j-th on, over rows begin <= row < end.
template <int A, int B>
Eigen::Matrix<double, A, B> BlockOfProducts(const Eigen::MatrixXd& columns, Eigen::Index i,
                                            Eigen::Index j, Eigen::Index begin, Eigen::Index end) {
  // two rows at a time, whose sums stay in registers
  using Two = Eigen::Array2d;
  Two sums[A][B];
  for (auto& row : sums) {
    for (Two& sum : row) sum.setZero();
  }
  const Eigen::Index stride = columns.rows();
  const double* first = columns.data() + i * stride;
  const double* other = columns.data() + j * stride;
  Eigen::Index row = begin;
  for (; row + 1 < end; row += 2) {
    for (int b = 0; b < B; ++b) {
      const Two right = Eigen::Map<const Two>(other + b * stride + row);
      for (int a = 0; a < A; ++a) {
        sums[a][b] += Eigen::Map<const Two>(first + a * stride + row) * right;
      }
    }
  }

  // and the row that is left
  Eigen::Matrix<double, A, B> block;
  for (int a = 0; a < A; ++a) {
    for (int b = 0; b < B; ++b) {
      block(a, b) = sums[a][b].sum();
      if (row < end) block(a, b) += first[a * stride + row] * other[b * stride + row];
    }
  }
  return block;
}

/// Calls write(i, j, product) for each two columns i <= j, and for some j < i, too, over rows begin <= row < end.
template <typename Write>
void ForEachProduct(const Eigen::MatrixXd& columns, Eigen::Index begin, Eigen::Index end,
                    Write&& write) {
  const auto take = [&]<int A, int B>(const Eigen::Matrix<double, A, B>& block, Eigen::Index i,
                                      Eigen::Index j) {
    for (int b = 0; b < B; ++b) {
      for (int a = 0; a < A; ++a) write(i + a, j + b, block(a, b));
    }
  };
  // blocks of two columns by two; of an odd number the last by itself
  const Eigen::Index c = columns.cols(), even = c - c % 2;
  for (Eigen::Index j = 0; j < even; j += 2) {
    for (Eigen::Index i = 0; i <= j; i += 2) {
      take(BlockOfProducts<2, 2>(columns, i, j, begin, end), i, j);
    }
  }
  if (even == c) return;
  for (Eigen::Index i = 0; i < even; i += 2) {
    take(BlockOfProducts<2, 1>(columns, i, even, begin, end), i, even);
  }
  take(BlockOfProducts<1, 1>(columns, even, even, begin, end), even, even);
}

/// All of them, [c x c], over all rows.
inline Eigen::MatrixXd ProductsOf(const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd products(columns.cols(), columns.cols());
  ForEachProduct(columns, 0, columns.rows(), [&](Eigen::Index i, Eigen::Index j, double product) {
    products(i, j) = products(j, i) = product;
  });
  return products;
}

}  // namespace warmjoint::inline identification
