#include <gmock/gmock.h>

#include <cmath>

#include "models/foundation/random_stream.h"
#include "models/friction/thermal.h"
#include "tests/support/judging.h"
#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

Estimate FitWarming(const Measurements& measurements,
                    const std::map<std::string, std::string>& given = {}) {
  return test::Fitted("energy-ml", measurements, given);
}

/// Torque of kv = 5, kc = 15 with `thermal` and E(0), plus noise, over a velocity at `time`.
Measurements Warm(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity,
                  const Thermal& thermal, double noise, double energy = 0) {
  RandomStream random({17, 0}, Stream::test);
  Measurements m = test::Record(1, velocity, velocity);
  m.time = time;
  for (Eigen::Index n = 0; n < time.size(); ++n) {
    const double v = velocity[n];
    const double force = WarmForce(v, 5 * v + 15 * Sign(v), energy);
    m.torque[n] = force + noise * random.Normal();
    if (n + 1 == time.size()) break;
    m.position[n + 1] = m.position[n] + v * (time[n + 1] - time[n]);
    const DiscreteThermal hold = Discretise(thermal, time[n + 1] - time[n]);
    energy = ThermalStep(hold.gain, hold.pole, energy, Loss(v, force));
  }
  return m;
}

Eigen::VectorXd EvenTime(int n) { return Eigen::VectorXd::LinSpaced(n, 0, n - 1.0); }

/// Speeds from 0.1 to 1 rad/s in turn, held 20 s, the sign alternating.
Eigen::VectorXd Speeds(int n) {
  Eigen::VectorXd v(n);
  for (int i = 0; i < n; ++i) v[i] = (i / 20 % 2 ? -0.1 : 0.1) * (1 + i / 20 * 7 % 10);
  return v;
}

void ExpectGolden(const Estimate& estimate, const nlohmann::json& golden) {
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  const std::map<std::string, std::string> names{{"kv", "viscous"},
                                                 {"kc", "coulomb"},
                                                 {"kbar", "thermal_gain"},
                                                 {"tbar", "thermal_time_constant"},
                                                 {"ke", "thermal_gain_discrete"},
                                                 {"te", "thermal_pole"}};
  for (const auto& [theirs, ours] : names) {
    const double expected = golden.at(theirs);
    EXPECT_NEAR(estimate.Find(ours)->value, expected, 1e-6 * std::abs(expected)) << ours;
  }
}

// 1e-6 on parameters and 1e-10 on the cost: two iterative optimisers at one minimum
TEST(EnergyMl, ReproducesTheGoldenMinimum) {
  const nlohmann::json& golden = test::Golden().at("dataset").at("joint_closed");
  const Measurements recording = test::GoldenRecording();
  const Estimate estimate = FitWarming(recording);
  ExpectGolden(estimate, golden);

  // the golden cost counts the samples at rest too, where friction is 0
  const Metrics& metrics = *estimate.metrics;
  const double rests = (recording.velocity.array() == 0).select(recording.torque, 0).squaredNorm();
  const double cost = golden.at("cost");
  EXPECT_NEAR(metrics.rmse * metrics.rmse * metrics.n + rests, cost, 1e-10 * cost);
}

TEST(EnergyMl, ReproducesTheGoldenMinimumWithInitialEnergy) {
  const nlohmann::json& golden = test::Golden().at("dataset").at("joint_closed_E0");
  const Estimate estimate = FitWarming(test::GoldenRecording(), {{"initial_energy", "estimated"}});
  ExpectGolden(estimate, golden);
  EXPECT_NEAR(estimate.Find("initial_energy")->value, golden.at("E0"), 1e-6);
}

TEST(EnergyMl, RecoversExactDataOfEveryTimeConstantWithoutAStart) {
  for (const double tau : {20.0, 150.0, 600.0, 1500.0}) {
    const Estimate estimate = FitWarming(Warm(EvenTime(3600), Speeds(3600), {-3, tau}, 0));
    ASSERT_EQ(estimate.status, Status::ok) << tau << ": " << estimate.message;
    // 1e-6: the residual of an exact fit is rounding, whose cost changes below 1e-10 stop the steps
    EXPECT_NEAR(estimate.Find("thermal_time_constant")->value, tau, 1e-6 * tau);
    EXPECT_NEAR(estimate.Find("coulomb")->value, 15, 1e-6);
  }
}

TEST(EnergyMl, RecoversFrictionThatGrowsWithWarmth) {
  const Estimate estimate = FitWarming(Warm(EvenTime(3600), Speeds(3600), {0.5, 300}, 0));
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_NEAR(estimate.Find("thermal_gain")->value, 0.5, 1e-6);
}

TEST(EnergyMl, RecoversUnevenSamplesWithRests) {
  Eigen::VectorXd time = EvenTime(2000), v = Speeds(2000);
  for (int i = 0; i < 2000; ++i) time[i] += 0.4 * std::sin(i);
  time.tail(1000).array() += 300;  // a gap, at rest
  v[999] = 0;
  v.segment(1200, 200).setZero();
  const Estimate estimate = FitWarming(Warm(time, v, {-3, 600}, 0));
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_NEAR(estimate.Find("thermal_time_constant")->value, 600, 1e-6 * 600);
  EXPECT_NEAR(estimate.Find("thermal_gain")->value, -3, 1e-6 * 3);
}

TEST(EnergyMl, FindsTheInitialEnergyOfAWarmJoint) {
  const Estimate estimate = FitWarming(Warm(EvenTime(3600), Speeds(3600), {-3, 600}, 0, -6),
                                       {{"initial_energy", "estimated"}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_NEAR(estimate.Find("initial_energy")->value, -6, 1e-5);
  EXPECT_NEAR(estimate.Find("coulomb")->value, 15, 1e-5);
}

TEST(EnergyMl, GivesFrictionWithWarming) {
  const Estimate estimate = FitWarming(Warm(EvenTime(3600), Speeds(3600), {-3, 600}, 0.5));
  ASSERT_TRUE(estimate.friction && estimate.friction->thermal);
  EXPECT_EQ(estimate.friction->thermal->gain, estimate.Find("thermal_gain")->value);
  EXPECT_GT((*estimate.Find("thermal_time_constant")->interval95)[0], 0);
  EXPECT_GE(estimate.trace.size(), 2u);
  EXPECT_NEAR(estimate.trace.back().rmse, estimate.metrics->rmse, 1e-12);
}

TEST(EnergyMl, SaysThatNoWarmUpCanBeSeen) {
  const Estimate cold = FitWarming(Warm(EvenTime(3600), Speeds(3600), {0, 600}, 0.5));
  EXPECT_EQ(cold.status, Status::not_identifiable);
  EXPECT_THAT(cold.message, HasSubstr("no warm-up can be seen"));
  EXPECT_TRUE(cold.parameters.empty());
}

TEST(EnergyMl, SaysThatARecordIsTooShort) {
  // half a minute of a time constant of ten, in some noise: a drift, but of what gain and time?
  const Estimate estimate = FitWarming(Warm(EvenTime(60), Speeds(60), {-3, 600}, 0.1));
  EXPECT_EQ(estimate.status, Status::not_identifiable);
  EXPECT_THAT(estimate.message, HasSubstr("thermal_time_constant"));
  EXPECT_FALSE(estimate.friction);
}

}  // namespace
}  // namespace warmjoint
