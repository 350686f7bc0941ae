#include "identification/maps/nearest_kernel.h"

#include <gmock/gmock.h>

namespace warmjoint {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;

/// Three places for each direction of motion.
FrictionMap ThreePlaces() {
  return {{{MapQuantity::position, EvenAxis(0, 2, 3)}, {MapQuantity::velocity, SpeedAxis(1, 1, 1)}},
          KernelKind::normalised,
          {}};
}

MapPoints At(const std::vector<std::array<double, 2>>& places) {
  MapPoints points = MapPoints::Zero(static_cast<Eigen::Index>(places.size()), 5);
  for (size_t i = 0; i < places.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    points(row, static_cast<int>(MapQuantity::position)) = places[i][0];
    points(row, static_cast<int>(MapQuantity::velocity)) = places[i][1];
  }
  return points;
}

TEST(NearestKernel, KeepsToTheSideOfTheMotion) {
  const MapPoints points = At({{0.4, -0.1}, {0.6, 0.1}, {9, 5}});
  EXPECT_EQ(NearestKernel(ThreePlaces(), points, 0), 0);
  EXPECT_EQ(NearestKernel(ThreePlaces(), points, 1), 3);
  EXPECT_EQ(NearestKernel(ThreePlaces(), points, 2), 5);
}

TEST(NearestKernel, IsFoundAroundACircle) {
  const FrictionMap turn{
      {{MapQuantity::motor_position, CircleAxis(4, 4)}}, KernelKind::normalised, {}};
  MapPoints points = MapPoints::Zero(1, 5);
  points(0, static_cast<int>(MapQuantity::motor_position)) = 3.8;
  EXPECT_EQ(NearestKernel(turn, points, 0), 0);
}

TEST(SpeedsAtKernels, AreTheMedianThereOrTheNextOnes) {
  const MapPoints points = At({{0, -1}, {0.1, -2}, {0.2, -9}, {2, -4}});
  EXPECT_THAT(SpeedsAtKernels(ThreePlaces(), points),
              ElementsAre(Optional(2.0), std::nullopt, Optional(2.0), std::nullopt, Optional(4.0),
                          std::nullopt));
}

}  // namespace
}  // namespace warmjoint
