#include "identification/maps/holes.h"

#include <gmock/gmock.h>

#include "identification/preparation/prepare.h"
#include "tests/support/judging.h"
#include "tests/support/travelling.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

TEST(Holes, AHoleInALogHoldsTheTruthAndIsToldOf) {
  // a level that rises from 5 to 25 N.m over the travel; nothing is logged backwards from 0.5 to 1.5 rad
  FrictionDescription friction = test::Cold();
  friction.maps = {test::Sampled(MapQuantity::position, EvenAxis(-2.5, 2.5, 64),
                                 MapFactor::direction, [](double p) { return 4 * p; })};
  Measurements m =
      test::RecordFriction(friction, 0.05, test::Travel(16000, 0.05, 2.5, {0.2, 0.5, 0.9}), 0.3, 1);
  Selection selection = Prepare(m).steady().selection;
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    if (m.velocity[i] < 0 && m.position[i] > 0.5 && m.position[i] < 1.5) selection.keep[i] = false;
  }
  const Estimate estimate =
      test::Fitted("position-ridge", Prepare(m, selection), {{"kernels", "20"}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_THAT(estimate.FullMessage(), HasSubstr("the map has no data at position"));
  EXPECT_THAT(estimate.FullMessage(), HasSubstr("backwards"));

  // in the middle of the hole: between the neighbours, and the interval holds the truth
  const MapBand& band = estimate.bands[0];
  bool looked = false;
  for (size_t i = 0; i < band.points.size(); ++i) {
    const double p = band.points[i][0], v = band.points[i][1];
    if (v > 0 || std::abs(p - 1) > 0.2) continue;
    const double truth = -(15 + 5 * std::abs(v) + 4 * p);
    EXPECT_NEAR(band.value[i], truth, 2) << p;
    EXPECT_LT(band.interval95[i][0], truth);
    EXPECT_GT(band.interval95[i][1], truth);
    EXPECT_GT(band.std[i], 2) << p;
    looked = true;
  }
  EXPECT_TRUE(looked);
}

}  // namespace
}  // namespace warmjoint
