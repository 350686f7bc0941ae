// What features look at: by hand, and what changes within each hold of constant speed and what outlasts it in logs.
#include "identification/lack_of_fit/features.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/judging.h"

namespace warmjoint {
namespace {

constexpr int kLogs = 20;

/// Table I beside a torque against the motion that swells and ebbs with every hold of 20 s. level: N.m
Measurements Swelling(double level, std::uint64_t seed) {
  Measurements m = test::RecordHour(test::TableOne(), seed);
  const auto wave = (std::numbers::pi / 20 * m.time.array()).sin().abs();
  m.torque.array() += level * m.velocity.array().sign() * wave;
  return m;
}

/// Table I whose friction follows the speed late in part. slope: N.m.s/rad; time_constant: s
Measurements Late(double slope, double time_constant, std::uint64_t seed) {
  Measurements m = test::RecordHour(test::TableOne(), seed);
  double followed = std::abs(m.velocity[0]);
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    const double speed = std::abs(m.velocity[i]);
    m.torque[i] += std::copysign(slope, m.velocity[i]) * (followed - speed);
    followed += -std::expm1(-1 / time_constant) * (speed - followed);
  }
  return m;
}

bool Holds(const Estimate& estimate, const std::string& name, double truth) {
  const EstimatedParameter* one = estimate.Find(name);
  if (!one->interval95) return true;
  const auto [lower, upper] = *one->interval95;
  return lower <= truth && truth <= upper;
}

TEST(HoldPhase, SeesWhatIsTheSameInBothHalvesOfAHold) {
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= kLogs; ++seed) {
    const Estimate estimate = test::Answer("energy-ml", Swelling(1, seed));
    seen += test::Asked(estimate, "hold_phase").rejected ||
            test::Asked(estimate, "hold_parity").rejected;
  }
  EXPECT_EQ(seen, kLogs);
}

TEST(HoldPhase, LetsIntervalsHoldTheMeanThatNobodySees) {
  // 0.25 N.m shift coulomb by 0.16 N.m, more than two deviations, and count as a detail
  int answered = 0;
  for (std::uint64_t seed = 1; seed <= kLogs; ++seed) {
    const Estimate estimate = test::Answer("energy-ml", Swelling(0.25, seed));
    const bool found = test::Asked(estimate, "hold_phase").rejected ||
                       test::Asked(estimate, "hold_parity").rejected;
    if (estimate.status != Status::ok || !found) continue;
    ++answered;
    EXPECT_TRUE(Holds(estimate, "coulomb", 15)) << seed;
    EXPECT_TRUE(Holds(estimate, "thermal_gain", -3)) << seed;
  }
  EXPECT_GE(answered, kLogs / 2);
}

TEST(SpeedMemory, SeesFrictionThatFollowsTheSpeedLate) {
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= kLogs; ++seed) {
    const Estimate estimate = test::Answer("energy-ml", Late(2, 200, seed));
    seen += test::Asked(estimate, "speed_memory").rejected;
  }
  // 80 % of 40 logs of the suite spoilt-logs: fewer than 11 of 20 come once in 400 times
  EXPECT_GE(seen, 11);
}

TEST(SpeedMemory, IsNotMadeWhereAHoldIsTooLongForTheLog) {
  Eigen::VectorXd velocity(600);
  for (Eigen::Index i = 0; i < 600; ++i) velocity[i] = i < 300 ? 0.5 : -0.8;
  const Estimate estimate =
      test::Answer("nominal-ls", test::RecordFriction(test::Cold(), 1, velocity, 0.5, 1));
  EXPECT_FALSE(test::Asked(estimate, "speed_memory").made);
}

}  // namespace
}  // namespace warmjoint
