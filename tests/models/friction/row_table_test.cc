#include "models/friction/row_table.h"

#include <gtest/gtest.h>
#include <warmjoint/friction.h>

#include <cmath>
#include <numbers>

#include "models/foundation/random_stream.h"
#include "models/friction/evaluate_map.h"

namespace warmjoint {
namespace {

constexpr double kFullTurn = 2 * std::numbers::pi;
constexpr size_t kRows = 3;

std::vector<double> Weights(const GaussianAxis& axis) {
  std::vector<double> weights;
  for (size_t i = 0; i < kRows * axis.size(); ++i) {
    weights.push_back(std::sin(1.0 + 2.0 * static_cast<double>(i)));
  }
  return weights;
}

/// Largest difference from the kernels themselves, over points where the table knows the value.
double WorstError(const GaussianAxis& axis, KernelKind kind, const RowTable& table, double reach) {
  const std::vector<double> weights = Weights(axis);
  RandomStream random({5, 2}, Stream::test);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const double x = random.Uniform(-reach, reach);
    RowTable::Spot spot;
    if (!table.Locate(x, spot)) continue;
    std::vector<double> phi(axis.size());
    AxisKernels(axis, kind, x, phi.data());
    for (size_t row = 0; row < kRows; ++row) {
      double sum = 0;
      for (size_t k = 0; k < phi.size(); ++k) sum += phi[k] * weights[row * phi.size() + k];
      worst = std::max(worst, std::abs(table.Value(row, spot) - sum));
    }
  }
  return worst;
}

TEST(RowTable, IsTheSumOfTheKernelsOnGridsAsMapsHaveThem) {
  // kernels so wide on a circle that the far side of each has a kink, between two cells
  GaussianAxis wide = CircleAxis(kFullTurn, 8);
  wide.width *= 3;
  for (const KernelKind kind : {KernelKind::plain, KernelKind::normalised}) {
    for (const GaussianAxis& axis : {CircleAxis(kFullTurn, 36), CircleAxis(kFullTurn, 7), wide,
                                     EvenAxis(-3, 3, 40), EvenAxis(0.5, 2, 5)}) {
      const RowTable table(axis, kind, Weights(axis));
      ASSERT_FALSE(table.empty()) << axis.size() << " centres";
      // 3e-13 is checked between the nodes, where the error is largest; weights are at most 1
      EXPECT_LE(WorstError(axis, kind, table, 9), 4e-13) << axis.size() << " centres";
    }
  }
}

TEST(RowTable, EndsHalfASpacingOutsideOfTheGridAndNeverOnACircle) {
  RowTable::Spot spot;
  const GaussianAxis line = EvenAxis(0, 4, 5);
  const RowTable table(line, KernelKind::normalised, Weights(line));
  EXPECT_TRUE(table.Locate(-0.499, spot));
  EXPECT_FALSE(table.Locate(-0.501, spot));
  EXPECT_TRUE(table.Locate(4.499, spot));
  EXPECT_FALSE(table.Locate(4.501, spot));
  EXPECT_FALSE(table.Locate(std::nan(""), spot));
  const GaussianAxis circle = CircleAxis(kFullTurn, 12);
  const RowTable around(circle, KernelKind::normalised, Weights(circle));
  EXPECT_FALSE(around.Locate(std::nan(""), spot));
  for (const double x : {-1e-18, 0.0, kFullTurn, -100.0, 1e6})
    EXPECT_TRUE(around.Locate(x, spot)) << x;
}

TEST(RowTable, StaysEmptyWhereItCannotBeExact) {
  GaussianAxis uneven = EvenAxis(0, 4, 5);
  uneven.centres[2] += 0.01;
  for (const GaussianAxis& axis : {uneven, SpeedAxis(0.1, 2, 3), EvenAxis(1, 2, 1)}) {
    const RowTable table(axis, KernelKind::plain, Weights(axis));
    EXPECT_TRUE(table.empty()) << axis.size() << " centres";
    RowTable::Spot spot;
    EXPECT_FALSE(table.Locate(1, spot));
  }

  // and where it would take more than a megabyte
  const GaussianAxis long_axis = EvenAxis(0, 1, 128);
  const std::vector<double> many(128 * 100, 1.0);
  EXPECT_TRUE(RowTable(long_axis, KernelKind::normalised, many).empty());
}

}  // namespace
}  // namespace warmjoint
