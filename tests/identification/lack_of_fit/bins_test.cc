#include "identification/lack_of_fit/bins.h"

#include <gtest/gtest.h>

#include <array>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Three bins of 12 samples, of which the first, one between and the last belong to none.
Bins Three() {
  Bins bins;
  bins.begin = {1, 4, 6};
  bins.end = {4, 5, 11};
  bins.weight = Eigen::Vector3d(3, 1, 5);
  return bins;
}

MatrixXd Columns(Index count) {
  RandomStream random({1, 0}, Stream::test);
  return MatrixXd::NullaryExpr(12, count, [&] { return random.Normal(); });
}

TEST(Bins, HoldMeansOfAnyNumberOfColumns) {
  for (const Index count : {0, 1, 4, 6}) {
    const MatrixXd all = Columns(count), means = Three().Means(all);
    ASSERT_EQ(means.cols(), count);
    // rounding of sums of up to 5
    for (const auto& [row, begin, samples] : {std::array{0, 1, 3}, {1, 4, 1}, {2, 6, 5}}) {
      const MatrixXd expected = all.middleRows(begin, samples).colwise().mean();
      EXPECT_LT((means.row(row) - expected).cwiseAbs().sum(), 1e-14) << count;
    }
  }
}

TEST(Bins, HoldTheSameMeansOfRowsThatComeOneByOne) {
  const Bins bins = Three();
  const MatrixXd all = Columns(8);
  const MatrixXd means = MeansOfRows<2>(bins, [&](Index n, Fours<2>& row) {
    for (Index k = 0; k < 8; ++k) row[static_cast<size_t>(k / 4)][k % 4] = all(n, k);
  });
  EXPECT_EQ(means, bins.Means(all));
}

}  // namespace
}  // namespace warmjoint
