#include "identification/fit_data.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

TEST(Kept, EvaluatesAnExpressionOnce) {
  // what makes an element is asked for each of them once, or a product would be made anew for each sample
  int asked = 0;
  const auto count = [&](Eigen::Index i, Eigen::Index j) {
    ++asked;
    return static_cast<double>(10 * i + j);
  };
  Selection selection{Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(100, true), {}};
  selection.keep[1] = false;
  const Eigen::MatrixXd twos = Eigen::MatrixXd::Identity(2, 2) * 2;
  const Eigen::MatrixXd kept = Kept(Eigen::MatrixXd::NullaryExpr(100, 2, count) * twos, selection);
  EXPECT_EQ(asked, 200);
  ASSERT_EQ(kept.rows(), 99);
  EXPECT_EQ(kept(0, 1), 2);
  EXPECT_EQ(kept(1, 0), 40);
  EXPECT_EQ(kept(98, 1), 1982);
}

}  // namespace
}  // namespace warmjoint
