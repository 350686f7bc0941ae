// A log that begins with a heat of which something is known.
#include "identification/warming/expected_start.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/support/judging.h"

namespace warmjoint {
namespace {

constexpr double kBegins = -6;  // N.m

/// Half an hour of the joint of Table I, warm at the start.
Measurements WarmLog(std::uint64_t seed, double noise = 0.3) {
  Measurements m =
      test::Record(1, test::AlternatingSpeeds(1800, seed), Eigen::VectorXd::Zero(1800));
  m.torque = PredictFriction(test::TableOne(), m, {kBegins}).force;
  RandomStream random({seed, 1}, Stream::torque_noise);
  for (double& torque : m.torque) torque += noise * random.Normal();
  return m;
}

Estimate Fitted(const Measurements& m, const std::map<std::string, std::string>& given) {
  return test::Fitted("energy-ml", m, given);
}

Estimate Expecting(const Measurements& m, double energy, double std) {
  return Fitted(m, {{"initial_energy", "expected"},
                    {"expected_energy", fmt::format("{}", energy)},
                    {"expected_energy_std", fmt::format("{}", std)}});
}

TEST(ExpectedStart, AWideOneIsNone) {
  const Measurements m = WarmLog(1);
  const Estimate alone = Fitted(m, {{"initial_energy", "estimated"}});
  const Estimate wide = Expecting(m, 0, 1e4);
  ASSERT_EQ(alone.status, Status::ok) << alone.message;
  ASSERT_EQ(wide.status, Status::ok) << wide.message;
  for (const EstimatedParameter& one : alone.parameters) {
    EXPECT_NEAR(wide.Find(one.name)->value, one.value, 1e-3 * *one.std) << one.name;
    EXPECT_NEAR(*wide.Find(one.name)->std, *one.std, 1e-3 * *one.std) << one.name;
  }
}

TEST(ExpectedStart, AnExactOneStaysWhereItIs) {
  const Estimate estimate = Expecting(WarmLog(2), kBegins, 0);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_NEAR(estimate.Find("initial_energy")->value, kBegins, 1e-6);
  EXPECT_LT(*estimate.Find("initial_energy")->std, 1e-6);
}

TEST(ExpectedStart, WhatIsKnownAddsToWhatTheLogTells) {
  // of two that know E(0) alike, the one that hears of it too is surer of the level, and not less
  // right: over twenty logs, 3 deviations are passed by chance once in 18
  constexpr double spread = 0.1;
  int beyond = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random({seed, 2}, Stream::torque_noise);
    const Measurements m = WarmLog(seed);
    const Estimate estimate = Expecting(m, kBegins + spread * random.Normal(), spread);
    const Estimate alone = Fitted(m, {{"initial_energy", "estimated"}});
    ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
    const EstimatedParameter& start = *estimate.Find("initial_energy");
    const EstimatedParameter& level = *estimate.Find("coulomb");
    EXPECT_LT(*start.std, spread * 1.001) << seed;
    EXPECT_LT(*level.std, *alone.Find("coulomb")->std) << seed;
    beyond += std::abs(level.value - 15) > 3 * *level.std;
    beyond += std::abs(start.value - kBegins) > 3 * *start.std;
  }
  EXPECT_LE(beyond, 1);
}

TEST(ExpectedStart, ALogThatContradictsItIsBelieved) {
  const Measurements m = WarmLog(3);
  const Estimate wrong = Expecting(m, -12, 0.05);
  const Estimate alone = Fitted(m, {{"initial_energy", "estimated"}});
  ASSERT_FALSE(wrong.warnings.empty());
  EXPECT_THAT(wrong.warnings.back(), testing::HasSubstr("check the pause"));
  EXPECT_NEAR(wrong.Find("initial_energy")->value, alone.Find("initial_energy")->value,
              1e-3 * *alone.Find("initial_energy")->std);
}

}  // namespace
}  // namespace warmjoint
