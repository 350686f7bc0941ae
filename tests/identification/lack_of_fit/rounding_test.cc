// A torque in whole steps: what rounding does is in the intervals, or there is no answer.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "models/foundation/random_stream.h"
#include "tests/support/judging.h"
#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kViscous = 0.8, kCoulomb = 4.5;

/// Holds of 5 s at 20 Hz, to and fro, for five minutes.
struct Plan {
  double step = 1;   // N.m, of the torque
  double noise = 0;  // N.m
  int speeds = 0;    // even from 0.1 to 1 rad/s, one after the other; 0: drawn for each hold
};

Measurements Rounded(const Plan& plan, std::uint64_t seed) {
  constexpr Index n = 6000, hold = 100;
  RandomStream motion({seed, 0}, Stream::motion), noise({seed, 1}, Stream::test);
  VectorXd velocity(n);
  for (Index k = 0; k < n / hold; ++k) {
    const double even =
        0.9 * static_cast<double>(k / 2 % std::max(plan.speeds, 1)) / std::max(plan.speeds - 1, 1);
    const double speed = plan.speeds > 0 ? 0.1 + even : motion.Uniform(0.1, 1);
    velocity.segment(k * hold, hold).setConstant(k % 2 ? -speed : speed);
  }
  Measurements m = test::Record(0.05, velocity, velocity);
  for (Index i = 0; i < n; ++i) {
    const double torque =
        kViscous * velocity[i] + std::copysign(kCoulomb, velocity[i]) + plan.noise * noise.Normal();
    m.torque[i] = plan.step * std::round(torque / plan.step);
  }
  return m;
}

TEST(TorqueInSteps, HasTheStepsInItsIntervals) {
  for (const double step : {1.0, 0.5, 0.1}) {
    for (const double noise : {0.01, 0.3}) {
      int asked = 0, held = 0;
      for (const int speeds : {0, 2, 3, 6, 12}) {
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
          const Estimate answer = test::Answer("nominal-ls", Rounded({step, noise, speeds}, seed));
          if (answer.status != Status::ok) continue;
          asked += 2;
          const int holds =
              test::Holds(answer, "viscous", kViscous) + test::Holds(answer, "coulomb", kCoulomb);
          held += holds;
        }
      }
      // of 40 intervals of 95 %, fewer than 34 hold once in a thousand times
      EXPECT_GE(held, 0.85 * asked) << "of " << asked << ", step " << step << ", noise " << noise;
    }
  }
}

TEST(TorqueInSteps, OfOneValueEachWayIsKnownNoBetterThanThey) {
  // from 4.58 to 5.3 N.m: all of them round to 5, and the fit is exact
  const Estimate answer = test::Answer("nominal-ls", Rounded({.noise = 0.01}, 1));
  EXPECT_NE(answer.FullMessage().find("comes in steps of"), std::string::npos)
      << answer.FullMessage();
  if (answer.status != Status::ok) return;
  const auto& interval = answer.Find("viscous")->interval95;
  ASSERT_TRUE(interval);
  // half a step over the range of the speeds, at least
  EXPECT_GT((*interval)[1] - (*interval)[0], 2 * 0.5 / 0.9);
}

}  // namespace
}  // namespace warmjoint
