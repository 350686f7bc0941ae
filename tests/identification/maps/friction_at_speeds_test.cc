#include "identification/maps/friction_at_speeds.h"

#include <gtest/gtest.h>

#include <cmath>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "tests/support/travelling.h"

namespace warmjoint {
namespace {

/// What position-ridge says of a joint whose level varies over its position, 1 + 0.3 sin.
Estimate Answer(std::uint64_t seed) {
  FrictionDescription truth{"viscous_coulomb", {{"viscous", 0.5}, {"coulomb", 2}}, {}, 0, 100};
  truth.maps = {test::PositionLevel(1, 0.3)};
  Measurements m = test::Record(0.1, test::Travel(6000, 0.1, 1, {0.31, 0.57, 0.57, 0.83}),
                                Eigen::VectorXd::Zero(6000));
  m.position.array() -= 1;
  m.torque = PredictFriction(truth, m).force;
  test::AddNoise(m, 0.1, 0, seed);
  const Identifier& identifier = FindIdentifier("position-ridge");
  const Options options(identifier.options, {{"kernels", "20"}, {"width", "1"}}, {});
  return IdentifyUnjudged(identifier, {Prepare(m), options, {}});
}

/// Mean of the level's sin over evenly passed positions between -1 and 1 rad.
const double kMeanOfSin = std::sin(0.5) * std::sin(4.0) / 4;

TEST(FrictionAtSpeeds, HoldsWhatLawAndMapBrakeWith) {
  int held = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Estimate estimate = Answer(seed);
    ASSERT_EQ(estimate.at_speeds.size(), 3u) << estimate.message;
    for (const FrictionAtSpeed& one : estimate.at_speeds) {
      const double truth = 0.5 * one.speed + 2 + 0.3 * kMeanOfSin;
      // places are passed evenly but for the ends of the travel, a hundredth of it
      EXPECT_NEAR(one.value, truth, 0.02) << one.speed;
      held += one.interval95[0] <= truth + 0.003 && truth - 0.003 <= one.interval95[1];
      ++all;
    }
    // known to the noise of 6000 samples, where the constant itself is not known at all
    EXPECT_LT(estimate.at_speeds[1].std, 2 * 0.1 / std::sqrt(6000));
    EXPECT_FALSE(estimate.Find("coulomb")->interval95);
  }
  EXPECT_GT(held, 0.9 * all);
}

TEST(FrictionAtSpeeds, AreTheLowestTheMedianAndTheHighest) {
  const Estimate estimate = Answer(1);
  ASSERT_EQ(estimate.at_speeds.size(), 3u);
  EXPECT_NEAR(estimate.at_speeds[0].speed, 0.31, 0.01);
  EXPECT_NEAR(estimate.at_speeds[2].speed, 0.83, 0.01);
  EXPECT_GT(estimate.at_speeds[1].speed, 0.31);
  EXPECT_LT(estimate.at_speeds[1].speed, 0.83);
}

}  // namespace
}  // namespace warmjoint
