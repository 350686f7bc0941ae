#include "identification/lack_of_fit/column_products.h"

#include <algorithm>
#include <cstring>

#include "models/foundation/four.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Columns to be multiplied with others, the ends of their parts, and where the products go.
struct Task {
  const MatrixXd& left;   // [m x a]
  const MatrixXd& right;  // [m x b]
  const Index* ends;      // [parts]
  Index parts;
  double* products;  // [parts x a b], of the i-th with the j-th in column i b + j
};

/// Which of four numbers count: all bits, or none.
using Bits = long long __attribute__((vector_size(32)));

/// Those from the first on, and before the last. 0 <= first, last <= 4
inline void Keep(Index first, Index last, Bits& keep) {
  static constexpr long long kFrom[8] = {0, 0, 0, 0, -1, -1, -1, -1};
  Bits from_last;
  std::memcpy(&keep, kFrom + 4 - first, sizeof(Bits));
  std::memcpy(&from_last, kFrom + 4 - last, sizeof(Bits));
  keep &= ~from_last;
}

/// Adds the products of four rows from `first` on, of those that count. left: A columns; right: B columns.
template <int A, int B>
inline void AddProducts(const double* const (&left)[A], const double* const (&right)[B],
                        Index first, const Bits& keep, Four (&sums)[A][B]) {
  Four of_left[A];
  for (int a = 0; a < A; ++a) {
    Load(left[a] + first, of_left[a]);
    of_left[a] = reinterpret_cast<Four>(reinterpret_cast<Bits>(of_left[a]) & keep);
  }
  for (int b = 0; b < B; ++b) {
    Four of_right;
    Load(right[b] + first, of_right);
    for (int a = 0; a < A; ++a) sums[a][b] += of_left[a] * of_right;
  }
}

/// The products of A columns from the i-th on with B columns from the j-th on, over each part. Of 4 rows or more.
template <int A, int B>
inline void WriteBlock(const Task& task, Index i, Index j) {
  const double *left[A], *right[B];
  double* products[A][B];
  for (int a = 0; a < A; ++a) left[a] = task.left.data() + (i + a) * task.left.rows();
  for (int b = 0; b < B; ++b) right[b] = task.right.data() + (j + b) * task.right.rows();
  for (int a = 0; a < A; ++a) {
    for (int b = 0; b < B; ++b) {
      products[a][b] = task.products + ((i + a) * task.right.cols() + j + b) * task.parts;
    }
  }

  Index row = 0;
  for (Index part = 0; part < task.parts; ++part) {
    // four rows at a time, whose sums stay in registers
    const Index end = task.ends[part];
    Four sums[A][B] = {};
    for (; row + 4 <= end; row += 4) AddProducts(left, right, row, Bits{-1, -1, -1, -1}, sums);
    // and those that are left, among four that are there
    if (row < end) {
      const Index first = std::max(end - 4, Index{0});
      Bits keep;
      Keep(row - first, end - first, keep);
      AddProducts(left, right, first, keep, sums);
      row = end;
    }
    for (int a = 0; a < A; ++a) {
      for (int b = 0; b < B; ++b) products[a][b][part] = SumOf(sums[a][b]);
    }
  }
}

/// The products of B columns from the j-th on with those before `last`, two at a time; of an odd number one by itself.
template <int B>
inline void WriteWith(const Task& task, Index j, Index last) {
  Index i = 0;
  for (; i + 2 <= last; i += 2) WriteBlock<2, B>(task, i, j);
  if (i < last) WriteBlock<1, B>(task, i, j);
}

/// Of columns with themselves, i <= j.
WARMJOINT_FOR_EACH_PROCESSOR
void WriteUpper(const Task& task) {
  const Index count = task.right.cols();
  Index j = 0;
  for (; j + 2 <= count; j += 2) WriteWith<2>(task, j, j + 2);
  if (j < count) WriteWith<1>(task, j, count);
}

/// Of each with each.
WARMJOINT_FOR_EACH_PROCESSOR
void WriteAll(const Task& task) {
  Index j = 0;
  for (; j + 2 <= task.right.cols(); j += 2) WriteWith<2>(task, j, task.left.cols());
  if (j < task.right.cols()) WriteWith<1>(task, j, task.left.cols());
}

/// Columns with zeros behind, so that there are the four rows that are looked at together.
MatrixXd Filled(const MatrixXd& columns) {
  MatrixXd filled = MatrixXd::Zero(4, columns.cols());
  filled.topRows(columns.rows()) = columns;
  return filled;
}

}  // namespace

MatrixXd ProductsByPart(const MatrixXd& columns, const std::vector<Index>& ends) {
  if (columns.rows() < 4) return ProductsByPart(Filled(columns), ends);
  MatrixXd products(static_cast<Index>(ends.size()), columns.cols() * columns.cols());
  WriteUpper({columns, columns, ends.data(), products.rows(), products.data()});
  return products;
}

MatrixXd ProductsOf(const MatrixXd& columns) {
  const Index c = columns.cols();
  const MatrixXd upper = ProductsByPart(columns, {columns.rows()});
  MatrixXd products(c, c);
  for (Index i = 0; i < c; ++i) {
    for (Index j = i; j < c; ++j) products(i, j) = products(j, i) = upper(0, i * c + j);
  }
  return products;
}

MatrixXd ProductsBetween(const MatrixXd& left, const MatrixXd& right) {
  if (left.rows() < 4) return ProductsBetween(Filled(left), Filled(right));
  // a row after the other, which is a column after the other of the transpose
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> products(left.cols(),
                                                                                  right.cols());
  const Index end = left.rows();
  WriteAll({left, right, &end, 1, products.data()});
  return products;
}

}  // namespace warmjoint
