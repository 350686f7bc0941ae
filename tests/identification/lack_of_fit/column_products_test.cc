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
  for (const Index count : {0, 1, 2, 3, 6, 7, 8, 9, 20}) {
    const MatrixXd columns = Columns(51, count);
    const MatrixXd expected = columns.transpose() * columns;
    ASSERT_EQ(ProductsOf(columns).rows(), count);
    // rounding of 51 products of about 1
    EXPECT_LT((ProductsOf(columns) - expected).cwiseAbs().sum(), 1e-12) << count;
  }
}

TEST(ColumnProducts, OfPartsAddUpToThoseOfAll) {
  const MatrixXd columns = Columns(50, 13);
  // an empty part, one of a single row, odd and even ones
  const MatrixXd parts = ProductsByPart(columns, {0, 1, 20, 50});
  const MatrixXd all = ProductsOf(columns);
  for (Index i = 0; i < columns.cols(); ++i) {
    for (Index j = i; j < columns.cols(); ++j) {
      // rounding of 50 products of about 1
      EXPECT_NEAR(parts.col(i * columns.cols() + j).sum(), all(i, j), 1e-12);
    }
  }
  EXPECT_EQ(parts(0, 1), 0);
  EXPECT_EQ(parts(1, 1), columns(0, 0) * columns(0, 1));
}

TEST(ColumnProducts, AreThoseOfTheMatrixWhateverTheNumberOfRows) {
  for (const Index rows : {1, 2, 3, 4, 5, 6, 7, 8, 50}) {
    const MatrixXd left = Columns(rows, 5), right = Columns(rows, 3).rowwise().reverse();
    const MatrixXd own = left.transpose() * left, between = left.transpose() * right;
    // rounding of 50 products of about 1
    EXPECT_LT((ProductsOf(left) - own).cwiseAbs().maxCoeff(), 1e-13) << rows;
    EXPECT_LT((ProductsBetween(left, right) - between).cwiseAbs().maxCoeff(), 1e-13) << rows;
  }
}

TEST(ColumnProducts, OfPartsOfAnyFewRowsAreTheirs) {
  const MatrixXd columns = Columns(9, 2);
  // parts that begin and end within the first four rows, and within the last
  const std::vector<Index> ends{1, 3, 4, 7, 9};
  const MatrixXd parts = ProductsByPart(columns, ends);
  Index begin = 0;
  for (size_t part = 0; part < ends.size(); ++part) {
    const Index count = ends[part] - begin;
    const double expected =
        columns.col(0).segment(begin, count).dot(columns.col(1).segment(begin, count));
    EXPECT_NEAR(parts(static_cast<Index>(part), 1), expected, 1e-14) << part;  // rounding of 3
    begin = ends[part];
  }
}

}  // namespace
}  // namespace warmjoint
