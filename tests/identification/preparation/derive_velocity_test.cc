#include "identification/preparation/derive_velocity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/foundation/random_stream.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::VectorXd;

constexpr double kPi = std::numbers::pi;

VectorXd Times(int n, double rate) { return VectorXd::LinSpaced(n, 0, (n - 1) / rate); }

TEST(DeriveVelocity, FollowsASinusoidInThePassBand) {
  const VectorXd time = Times(4000, 1000);
  const double w = 2 * kPi * 5;  // rad/s
  const VectorXd position = (w * time.array()).sin();
  const VectorXd expected = w * (w * time.array()).cos();
  const VectorXd velocity = DeriveVelocity(time, position, 100);
  // central differences lose (w h)^2 / 6 = 1.6e-4 of the slope, the filter twice (5/100)^8 / 2
  const auto inner = (velocity - expected).segment(100, 3800).cwiseAbs();
  EXPECT_LT(inner.maxCoeff(), 1.7e-4 * w);
}

TEST(ChooseCutoff, HoldsTheNoiseOfTheVelocityAtOnePercent) {
  RandomStream random({5, 6}, Stream::test);
  const VectorXd time = Times(20000, 1000);
  const VectorXd clean = (2 * time.array()).sin();
  for (const double noise : {1e-4, 5e-4}) {
    VectorXd position = clean;
    for (double& p : position) p += noise * random.Normal();
    const double cutoff = ChooseCutoff(time, position);
    ASSERT_LT(cutoff, 100);
    ASSERT_GT(cutoff, 20) << "not the floor";

    const VectorXd error =
        DeriveVelocity(time, position, cutoff) - DeriveVelocity(time, clean, cutoff);
    const double rms = std::sqrt(error.squaredNorm() / 20000.0);
    // 1 % of 2 / sqrt(2); a Butterworth run twice passes 0.9 of the power of an ideal low-pass
    EXPECT_NEAR(rms, 0.01 * std::sqrt(2.0), 0.15 * 0.01 * std::sqrt(2.0)) << noise;
  }
}

}  // namespace
}  // namespace warmjoint
