#include "identification/preparation/position_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::VectorXd;

VectorXd Way() { return (0.7 * VectorXd::LinSpaced(2000, 0, 100).array()).sin(); }

TEST(PositionNoise, IsThatOfRoundingForAnEncoder) {
  const double step = 2 * std::numbers::pi / 4096;
  const PositionNoise noise = MeasurePositionNoise(step * (Way() / step).array().round());
  EXPECT_NEAR(noise.resolution, step, 1e-12);
  EXPECT_NEAR(noise.deviation, step / std::sqrt(12), 1e-12);
  EXPECT_NEAR(noise.reach, 0.51 * step, 1e-12);
}

TEST(PositionNoise, IsReadFromThirdDifferences) {
  RandomStream random({1, 1}, Stream::test);
  VectorXd noisy = Way();
  for (double& p : noisy) p += 0.003 * random.Normal();
  const PositionNoise noise = MeasurePositionNoise(noisy);
  EXPECT_EQ(noise.resolution, 0);
  // of the median of 2000 correlated differences: about 2.5 %
  EXPECT_NEAR(noise.deviation, 0.003, 0.1 * 0.003);
  EXPECT_EQ(noise.reach, 4.5 * noise.deviation);
}

TEST(FromFirst, DoesNotDependOnWhereTheEncoderHasItsZero) {
  const double step = 2 * std::numbers::pi / 4096;
  const VectorXd counts = (Way() / step).array().round();
  const RelativePosition here = FromFirst(step * counts);
  const RelativePosition there = FromFirst(step * counts.array() + 200 * std::numbers::pi);
  const VectorXd from_first = counts.array() - counts[0];
  EXPECT_EQ(here.steps, from_first);
  EXPECT_EQ(there.steps, here.steps);
  EXPECT_NEAR(there.step, step, 1e-9 * step);
}

}  // namespace
}  // namespace warmjoint
