#include "identification/ridge/row_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/support/maps_of_every_kind.h"

namespace warmjoint {
namespace {

class RowGroups : public ::testing::TestWithParam<KernelKind> {};

TEST_P(RowGroups, HoldEveryKernelOfEverySampleOnce) {
  const std::vector<FrictionMap> maps = test::MapsOfEveryKind(GetParam());
  const MapPoints points = test::DrawnPoints(900);
  const Eigen::MatrixXd kernels = test::DenseRows(maps, points);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(kernels.rows(), kernels.cols());
  for (const RowGroup& group : GroupRows(maps, points, 100, 900)) {
    EXPECT_TRUE(std::ranges::is_sorted(group.kernels));
    for (size_t i = 0; i < group.samples.size(); ++i) {
      for (size_t k = 0; k < group.kernels.size(); ++k) {
        rows(group.samples[i], group.kernels[k]) += group.values(i, k);
      }
    }
  }
  // what a prepared axis leaves out is below 3e-13 of the largest kernel, so that sums change by no more than
  // 1e-12 (prepared_map.h), and no kernel exceeds 1
  EXPECT_LE((rows - kernels).bottomRows(800).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(rows.topRows(100).norm(), 0);
}

INSTANTIATE_TEST_SUITE_P(Kernels, RowGroups,
                         ::testing::Values(KernelKind::plain, KernelKind::normalised),
                         [](const auto& kind) {
                           return kind.param == KernelKind::plain ? "plain" : "normalised";
                         });

TEST(RowGroups, AreFewWhereWindowsMoveALittle) {
  // 36 kernels a turn, of which 23 count at a point, and 72 places of these windows
  const std::vector<FrictionMap> maps{
      {{{MapQuantity::motor_position, CircleAxis(2 * std::numbers::pi, 36)}},
       KernelKind::normalised,
       {}}};
  MapPoints points = MapPoints::Zero(720, 5);
  points.col(static_cast<int>(MapQuantity::motor_position)).setLinSpaced(0, 6.28);
  const std::vector<RowGroup> groups = GroupRows(maps, points, 0, 720);
  EXPECT_LE(groups.size(), 36u);
  for (const RowGroup& group : groups) EXPECT_LT(group.kernels.size(), 30u);
}

}  // namespace
}  // namespace warmjoint
