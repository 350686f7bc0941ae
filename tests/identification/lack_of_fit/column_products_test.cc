#include "identification/lack_of_fit/column_products.h"

#include <gtest/gtest.h>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd Columns(Index rows, Index count) {
  RandomStream random({1, 0}, Stream::test);
  return MatrixXd::NullaryExpr(rows, count, [&] { return random.Normal(); });
}

TEST(ColumnProducts, AreThoseOfTheMatrix) {
  for (const Index count : {0, 1, 2, 3, 6, 7}) {
    const MatrixXd columns = Columns(51, count);
    const MatrixXd expected = columns.transpose() * columns;
    ASSERT_EQ(ProductsOf(columns).rows(), count);
    // rounding of 51 products of about 1
    EXPECT_LT((ProductsOf(columns) - expected).cwiseAbs().sum(), 1e-12) << count;
  }
}

TEST(ColumnProducts, OfPartsAddUpToThoseOfAll) {
  const MatrixXd columns = Columns(50, 5);
  MatrixXd sum = MatrixXd::Zero(5, 5);
  // an empty part, one of a single row, odd and even ones
  for (const auto& [begin, end] : {std::pair{0, 0}, {0, 1}, {1, 20}, {20, 50}}) {
    ForEachProduct(columns, begin, end, [&](Index i, Index j, double product) {
      if (i <= j) sum(i, j) += product;
    });
  }
  const MatrixXd difference = sum - ProductsOf(columns);
  EXPECT_LT(MatrixXd(difference.triangularView<Eigen::Upper>()).cwiseAbs().sum(), 1e-12);
}

}  // namespace
}  // namespace warmjoint
