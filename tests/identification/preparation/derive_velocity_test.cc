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

TEST(DeriveVelocity, LeavesTheFilterOutAboveFourTenthsOfTheRate) {
  const VectorXd time = Times(50, 10);
  VectorXd position = VectorXd::Zero(50);
  position[25] = 1;
  const VectorXd velocity = DeriveVelocity(time, position, 4.1);
  EXPECT_NEAR(velocity[24], 5, 1e-12);
  EXPECT_NEAR(velocity[26], -5, 1e-12);
  EXPECT_EQ((velocity.array() != 0).count(), 2);
  EXPECT_GT((DeriveVelocity(time, position, 3.9).array() != 0).count(), 10);
}

TEST(DeriveVelocity, TakesUnevenSteps) {
  RandomStream random({9, 1}, Stream::test);
  VectorXd time = Times(4000, 200);
  for (double& t : time) t += random.Uniform(-0.002, 0.002);
  const VectorXd velocity = DeriveVelocity(time, (3 * time.array()).sin(), 20);
  const VectorXd expected = 3 * (3 * time.array()).cos();
  // straight lines across 0.009 s cut corners by a h^2 / 8 = 9e-5 rad, which their slope shows over
  // some hundredths of a second
  EXPECT_LT((velocity - expected).segment(50, 3900).cwiseAbs().maxCoeff(), 0.005 * 3);
}

TEST(DeriveVelocity, TreatsPiecesBetweenGapsOneByOne) {
  VectorXd time = Times(400, 100);
  VectorXd position = 0.5 * time;
  time.tail(200).array() += 60;
  position.tail(200).array() += 1000;
  const VectorXd velocity = DeriveVelocity(time, position, 10);
  EXPECT_LT((velocity.array() - 0.5).abs().maxCoeff(), 1e-10) << "the jump in the gap is no speed";
}

TEST(DeriveVelocity, TakesThreeSamples) {
  const VectorXd velocity = DeriveVelocity(Eigen::Vector3d(0, 1, 2), Eigen::Vector3d(0, 2, 4), 0.1);
  EXPECT_NEAR((velocity.array() - 2).abs().maxCoeff(), 0, 1e-12);
}

TEST(ChooseCutoff, IsHighWhereThePositionIsClean) {
  const VectorXd time = Times(10000, 1000);
  EXPECT_EQ(ChooseCutoff(time, (3 * time.array()).sin()), 100);
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

TEST(ChooseCutoff, FallsForACoarseEncoder) {
  const VectorXd time = Times(20000, 250);
  const VectorXd clean = (2 * time.array()).sin();
  const double step = 2 * kPi / 4096;
  const VectorXd coarse = step * (clean.array() / step).round();
  const double cutoff = ChooseCutoff(time, coarse);
  EXPECT_LT(cutoff, 30);
  const VectorXd error =
      DeriveVelocity(time, coarse, cutoff) - 2 * (2 * time.array()).cos().matrix();
  // the noise of rounding is not quite white: at most twice the 1 % that is aimed at
  EXPECT_LT(std::sqrt(error.squaredNorm() / 20000.0), 0.02 * std::sqrt(2.0));
}

TEST(Resolution, IsTheStepOfAQuantisedSignal) {
  const VectorXd clean = Times(1000, 10).array().sin();
  const VectorXd coarse = 0.0125 * (clean / 0.0125).array().round();
  EXPECT_NEAR(Resolution(coarse), 0.0125, 1e-12);
  EXPECT_EQ(Resolution(clean), 0);
  EXPECT_EQ(Resolution(Times(100, 10)), 0) << "a straight line";
  EXPECT_EQ(Resolution(VectorXd::Constant(10, 3.0)), 0);
}

TEST(WhiteNoise, LooksThroughSmoothMotionAndJumps) {
  RandomStream random({7, 8}, Stream::test);
  VectorXd x = 100 * Times(20000, 1000).array().sin();
  for (double& value : x) value += 0.02 * random.Normal();
  x.tail(7000).array() += 50;
  // the median of 20 000 correlated magnitudes is good to about 2 %
  EXPECT_NEAR(WhiteNoise(x), 0.02, 0.06 * 0.02);
}

}  // namespace
}  // namespace warmjoint
