#include "identification/forward/row_products.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

/// The largest difference from the product of the rows held at once, relative to its largest entry.
template <int P>
double Difference(const Eigen::MatrixXd& rows) {
  RowProducts<P> products(rows.cols());
  for (Eigen::Index n = 0; n < rows.rows(); ++n) {
    const auto row = products.Next();
    for (Eigen::Index i = 0; i < rows.cols(); ++i) row[i] = rows(n, i);
  }
  const Eigen::MatrixXd expected = rows.transpose() * rows;
  return (products.Sums() - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

TEST(RowProducts, AreThoseOfAllRowsWhereverABlockEnds) {
  for (const Eigen::Index n : {1, 2, 127, 128, 129, 1000}) {
    const Eigen::MatrixXd rows = Eigen::MatrixXd::Random(n, 5);
    // 1e-13: sums of up to a thousand products of order 1 in another order
    EXPECT_LE(Difference<5>(rows), 1e-13) << n;
    EXPECT_LE(Difference<Eigen::Dynamic>(rows), 1e-13) << n;
  }
}

TEST(RowProducts, GoOnAfterTheyWereRead) {
  RowProducts<2> products(2);
  for (int i = 1; i <= 3; ++i) {
    const auto row = products.Next();
    row[0] = i;
    row[1] = 1;
    EXPECT_EQ(products.Sums()(1, 1), i);
  }
  EXPECT_EQ(products.Sums()(0, 0), 1 + 4 + 9);
  EXPECT_EQ(products.Sums()(1, 0), 1 + 2 + 3);
}

TEST(RowProducts, OfNoRowsAreZero) {
  EXPECT_TRUE(RowProducts<3>(3).Sums().isZero(0));
  EXPECT_TRUE(RowProducts<Eigen::Dynamic>(3).Sums().isZero(0));
}

}  // namespace
}  // namespace warmjoint
