#include "identification/lack_of_fit/held_loss.h"

#include <cmath>

#include "identification/identifiers/identifier_list.h"
#include "identification/preparation/prepare.h"
#include "identification/read_options.h"
#include "models/foundation/robust_noise.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

using Eigen::Index;

/// A joint of 30 s at 1 Hz, 20 min. part: steps of the plant in each sample; noise: N.m.
Measurements Quick(std::uint64_t seed, Index part, double noise) {
  FrictionDescription friction = test::TableOne();
  friction.thermal = Thermal{-3, 30};
  const Eigen::VectorXd slow = test::AlternatingSpeeds(1200, seed);
  const Eigen::VectorXd fast = slow.transpose().replicate(part, 1).reshaped();
  const Measurements all =
      test::RecordFriction(friction, 1.0 / static_cast<double>(part), fast, 0, seed);
  Measurements m = test::RecordFriction(friction, 1, slow, 0, seed);
  RandomStream random({seed, 0}, Stream::torque_noise);
  for (Index n = 0; n < m.size(); ++n) m.torque[n] = all.torque[n * part] + noise * random.Normal();
  return m;
}

TEST(HeldLoss, IsWhatContinuousHeatAddsAtOneSpeed) {
  // dE/dt = (k |v| (F0 + E) - E)/tau settles with r/tau, r = 1 - k |v|; by (22) with another rate
  FrictionDescription friction = test::TableOne();
  friction.thermal = Thermal{-3, 30};
  const Measurements m =
      test::RecordFriction(friction, 1, Eigen::VectorXd::Constant(60, 0.5), 0, 1);
  const Eigen::VectorXd force = m.torque + ForceOfHeldLoss(friction, m);
  const double level = 15 + 5 * 0.5, r = 1 + 3 * 0.5;
  for (Index n = 0; n < m.size(); ++n) {
    const double settled = level - level * (1 - 1 / r) * (1 - std::exp(-r * m.time[n] / 30));
    // an eighth of a step leaves less than h^2/64 of the curvature: 17.5 0.6 (2.5/30)^2/64
    EXPECT_NEAR(force[n], settled, 2e-3);
  }
}

/// Of 20 recordings, how many intervals of tau and of the gain hold the truth.
Eigen::Vector2i Covered(Index part, double noise) {
  Eigen::Vector2i covered = Eigen::Vector2i::Zero();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Estimate estimate = test::Answer("energy-ml", Quick(seed, part, noise));
    EXPECT_EQ(estimate.status, Status::ok) << estimate.FullMessage();
    const auto holds = [&](const char* name, double truth) -> int {
      const EstimatedParameter* found = estimate.Find(name);
      if (!found || !found->interval95) return 0;
      const auto [lower, upper] = *found->interval95;
      return lower <= truth && truth <= upper;
    };
    covered += Eigen::Vector2i(holds("thermal_time_constant", 30), holds("thermal_gain", -3));
  }
  return covered;
}

// of 20 intervals of 95 %, fewer than 16 hold the truth once in 400 times
constexpr int kMost = 16;

TEST(HeldLoss, LeavesIntervalsThatHoldTheTruthOfContinuousHeat) {
  for (const double noise : {0.02, 0.1, 0.5}) {
    EXPECT_GE(Covered(50, noise).minCoeff(), kMost) << noise;
  }
}

TEST(HeldLoss, LeavesIntervalsThatHoldTheTruthOfAnIdealPlant) {
  for (const double noise : {0.02, 0.1, 0.5}) {
    EXPECT_GE(Covered(1, noise).minCoeff(), kMost) << noise;
  }
}

}  // namespace
}  // namespace warmjoint
