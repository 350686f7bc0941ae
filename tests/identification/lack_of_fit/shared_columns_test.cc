#include "identification/lack_of_fit/shared_columns.h"

#include <gtest/gtest.h>

#include "identification/lack_of_fit/growing_fit.h"
#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kRows = 90;

MatrixXd Random(Index rows, Index columns, std::uint64_t seed) {
  RandomStream random({seed, 0}, Stream::test);
  return MatrixXd::NullaryExpr(rows, columns, [&] { return random.Normal(); });
}

/// Three columns of seven different rows.
SharedColumns Columns() {
  SharedColumns columns{{}, Random(kRows, 1, 1), Random(7, 3, 2)};
  for (Index i = 0; i < kRows; ++i) columns.place.push_back(i * i % 7);
  return columns;
}

TEST(SharedColumns, AreColumns) {
  const SharedColumns columns = Columns();
  for (Index j = 0; j < 3; ++j) {
    const VectorXd column = columns.Column(j);
    for (Index i = 0; i < kRows; ++i) {
      EXPECT_EQ(column[i], columns.factor[i] * columns.shares(i * i % 7, j));
    }
  }
}

TEST(SharedColumns, ExplainWhatTheyDoOneByOne) {
  const SharedColumns columns = Columns();
  MatrixXd all(kRows, 3);
  for (Index j = 0; j < 3; ++j) all.col(j) = columns.Column(j);
  const GrowingFit fit(Random(kRows, 1, 3).cwiseAbs(), Random(kRows, 1, 4), Random(kRows, 2, 5),
                       {Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(kRows, true), {}});
  const VectorXd once = fit.ExplainedBy(columns), each = fit.ExplainedBy(all);
  // rounding of 90 products
  EXPECT_LT((once - each).cwiseAbs().maxCoeff(), 1e-12 * each.maxCoeff());
}

}  // namespace
}  // namespace warmjoint
