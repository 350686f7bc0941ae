#include "identification/maps/finer_maps.h"

#include <gtest/gtest.h>

#include "models/friction/gaussian_axis.h"

namespace warmjoint {
namespace {

TEST(FinerMaps, HaveTwiceTheKernelsOverTheSameRange) {
  FrictionMap map{{{MapQuantity::position, EvenAxis(-1, 2, 4)}}, KernelKind::normalised, {}};
  map.axes[0].kernels.width *= 1.5;
  const GaussianAxis finer = TwiceAsFine({map})[0].axes[0].kernels;
  ASSERT_EQ(finer.centres.size(), 8u);
  EXPECT_EQ(finer.centres.front(), -1);
  EXPECT_EQ(finer.centres.back(), 2);
  EXPECT_NEAR(finer.width, 1.5 * 3 / 7, 1e-12);  // three in seven of a range of 3
}

TEST(FinerMaps, StayOnTheirCircleAndLeaveOtherQuantitiesAlone) {
  const FrictionMap turn{
      {{MapQuantity::motor_position, CircleAxis(6, 3)}}, KernelKind::normalised, {}};
  const FrictionMap heat{{{MapQuantity::energy, EvenAxis(-1, 0, 4)}}, KernelKind::normalised, {}};
  const auto finer = TwiceAsFine({turn, heat});
  EXPECT_EQ(finer[0].axes[0].kernels.centres, (std::vector<double>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(finer[1].axes[0].kernels.centres.size(), 4u);
}

}  // namespace
}  // namespace warmjoint
