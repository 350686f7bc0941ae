#include "tools/report/run/extremes.h"

#include <gtest/gtest.h>

#include <limits>

namespace warmjoint::report {
namespace {

RunRow RowOf(const std::vector<double>& npe) {
  RunRow row;
  const auto n = static_cast<Eigen::Index>(npe.size());
  row.npe = Eigen::Map<const Eigen::VectorXd>(npe.data(), n);
  row.variant = Eigen::VectorXi::Zero(n);
  row.realization = Eigen::VectorXi::LinSpaced(n, 0, static_cast<int>(n) - 1);
  return row;
}

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

TEST(Extremes, AreBestMedianAndWorstOfWhatWasAnswered) {
  const auto extremes = ExtremesOf(RowOf({0.4, kUnknown, 0.1, 0.3, 0.2, 0.9}));
  ASSERT_EQ(extremes.size(), 3u);
  EXPECT_EQ(extremes[0].rank, "best");
  EXPECT_EQ(extremes[0].unit, (Unit{0, 2}));
  EXPECT_EQ(extremes[1].rank, "median");
  EXPECT_EQ(extremes[1].unit, (Unit{0, 3}));
  EXPECT_EQ(extremes[1].npe, 0.3);
  EXPECT_EQ(extremes[2].rank, "worst");
  EXPECT_EQ(extremes[2].unit, (Unit{0, 5}));
}

TEST(Extremes, AreFewerOfShortRuns) {
  EXPECT_TRUE(ExtremesOf(RowOf({kUnknown})).empty());
  EXPECT_EQ(ExtremesOf(RowOf({0.2})).size(), 1u);
  EXPECT_EQ(ExtremesOf(RowOf({0.3, 0.2})).size(), 2u);
}

TEST(Extremes, OfEqualErrorsAreTheFirstRealizations) {
  const auto extremes = ExtremesOf(RowOf({0.2, 0.2, 0.2}));
  ASSERT_EQ(extremes.size(), 3u);
  EXPECT_EQ(extremes[0].unit, (Unit{0, 0}));
  EXPECT_EQ(extremes[2].unit, (Unit{0, 2}));
}

}  // namespace
}  // namespace warmjoint::report
