#include "identification/maps/warm_maps.h"

#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include <string>

#include "identification/forward/log_trajectory.h"
#include "identification/holdout/hold_out.h"
#include "identification/preparation/select.h"
#include "tests/support/judging.h"
#include "tests/support/travelling.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

/// 20 min at 5 Hz of a YuMi-like joint: levels of about 0.5 N.m that fade by 40 %, ripple over the
/// position.
Friction YumiLike() {
  Friction friction{
      "viscous_coulomb", {{"viscous", 0.0527}, {"coulomb", 0.48}}, Thermal{-0.194, 180}, 0, 1};
  friction.maps = {test::PositionLevel(1.5, 0.06)};
  return friction;
}

Measurements Recorded(const Friction& friction, double noise, std::uint64_t seed) {
  return test::RecordFriction(friction, 0.2, test::Travel(6000, 0.2, 1.5, {0.3, 0.6, 1, 1.5, 2}),
                              noise, seed);
}

Estimate Identify(const Measurements& m, const char* name,
                  const std::map<std::string, std::string>& given) {
  return test::Fitted(name, Prepare(m, SelectMoving(m)), given);
}

const std::map<std::string, std::string> kMap{
    {"kernels", "30"}, {"width", "1"}, {"position", "map"}};

TEST(WarmMaps, FindTheWarmingBesideAMap) {
  const Estimate estimate = Identify(Recorded(YumiLike(), 0.01, 1), "energy-ml", kMap);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  std::map<std::string, double> truth = test::TruthOf(YumiLike());
  // which the kernels can imitate
  if (!estimate.Find("coulomb")->std) truth.erase("coulomb");
  // 4 of its own standard deviations, which must be small themselves
  test::ExpectTold(estimate, truth, 4, 0.05);
  EXPECT_NEAR(estimate.metrics->rmse, 0.01, 0.01 * 0.05);  // 1 / sqrt(2 n) is 0.9 %
}

TEST(WarmMaps, SayWhereNothingWarms) {
  Friction cold = YumiLike();
  cold.thermal.reset();
  const Estimate estimate = Identify(Recorded(cold, 0.01, 3), "energy-ml", kMap);
  EXPECT_EQ(estimate.status, Status::not_identifiable);
  EXPECT_THAT(estimate.message, HasSubstr("no warm-up can be seen"));
}

TEST(WarmMaps, FindTheWarmingBesideAMotorMap) {
  Friction truth = YumiLike();
  truth.gear = 100;
  truth.maps.push_back(test::MotorRipple(2, 0.05));
  const Eigen::VectorXd velocity = test::Travel(12000, 0.05, 1.5, {0.31, 0.57, 0.93, 1.4});
  const Estimate estimate =
      Identify(test::RecordTravel(truth, 0.05, velocity, 0, 0.01, 0, 8), "energy-ml",
               {{"position", "motor"}, {"kernels", "30"}, {"width", "1"}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_THAT(estimate.message, ::testing::ContainsRegex("motor ripple for v > 0: 0.0[45][0-9.]* "
                                                         "N.m at 2 a turn; .* at 2 a turn"));
  // its own deviations, small themselves
  test::ExpectTold(estimate, {{"thermal_gain", -0.194}, {"thermal_time_constant", 180}}, 4, 0.05);
  EXPECT_NEAR(estimate.metrics->rmse, 0.01, 0.01 * 0.05);
}

/// Of a joint that has moved for 300 s as the log begins.
struct WarmLog {
  Measurements log;
  double energy = 0;  // E at its first sample, N.m
};

WarmLog WithoutItsBeginning(std::uint64_t seed) {
  const Friction truth = YumiLike();
  const Measurements m = Recorded(truth, 0.001, seed);
  return {test::Without(m, {{-1, 299.9}}), PredictFriction(truth, LogSamples(m)).energy[1500]};
}

TEST(WarmMaps, EstimateHowWarmTheJointWas) {
  const WarmLog warm = WithoutItsBeginning(4);
  auto given = kMap;
  given["initial_energy"] = "estimated";
  const Estimate estimate = Identify(warm.log, "energy-ml", given);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  // 4 of its own standard deviations, which must be small themselves
  test::ExpectTold(
      estimate,
      {{"initial_energy", warm.energy}, {"thermal_gain", -0.194}, {"thermal_time_constant", 180}},
      4, 0.1);
}

TEST(WarmMaps, HoldAnExpectedStartAgainstTheLog) {
  const WarmLog warm = WithoutItsBeginning(5);
  auto given = kMap;
  given["initial_energy"] = "expected";
  given["expected_energy"] = std::to_string(warm.energy + 1e-3);
  given["expected_energy_std"] = "0.001";
  const Estimate agreed = Identify(warm.log, "energy-ml", given);
  ASSERT_EQ(agreed.status, Status::ok) << agreed.message;
  test::ExpectTold(agreed, {{"initial_energy", warm.energy}}, 4, 0.1);
  EXPECT_LT(*agreed.Find("initial_energy")->std, 0.0011);
  EXPECT_THAT(agreed.warnings, ::testing::Not(::testing::Contains(HasSubstr("log begins at"))));

  // a joint that is twice as warm, for all that is known
  given["expected_energy"] = std::to_string(2 * warm.energy);
  const Estimate contradicted = Identify(warm.log, "energy-ml", given);
  ASSERT_EQ(contradicted.status, Status::ok) << contradicted.message;
  test::ExpectTold(contradicted, {{"initial_energy", warm.energy}}, 4, 0.1);
  EXPECT_THAT(contradicted.warnings, ::testing::Contains(HasSubstr("log begins at")));
}

TEST(WarmMaps, EstimateWhatAGapHides) {
  // a joint that turns three times as fast while nothing is recorded, and makes more heat
  const Friction truth = YumiLike();
  const Eigen::VectorXd slow = test::Travel(6000, 0.2, 1.5, {0.3, 0.6, 1});
  Eigen::VectorXd velocity = slow;
  velocity.segment(2000, 500) *= 3;
  const Measurements all = test::RecordFriction(truth, 0.2, velocity, 0.01, 6);
  const Measurements m = test::Without(all, {{400, 500}});
  const Estimate estimate = Identify(m, "energy-ml", kMap);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  test::ExpectTold(estimate, {{"thermal_gain", -0.194}, {"thermal_time_constant", 180}}, 4, 0.1);

  // beside a filter that holds the last loss through the gap
  const double held = PredictFriction(truth, LogSamples(m)).energy[2001];
  const double jump = PredictFriction(truth, LogSamples(all)).energy[2500] - held;
  test::ExpectTold(estimate, {{"energy_jump_1", jump}}, 4, 0.1);
}

TEST(LoadMap, FindsALevelThatGrowsWithTheLoad) {
  Friction truth = YumiLike();
  truth.maps = {{{{MapQuantity::load, EvenAxis(0, 10, 11)}},
                 KernelKind::normalised,
                 {},
                 MapFactor::direction}};
  for (const double load : truth.maps[0].axes[0].kernels.centres) {
    truth.maps[0].weights.push_back(0.01 * load);
  }
  Measurements m = Recorded(truth, 0, 5);
  m.load = Eigen::VectorXd(m.size());
  for (Eigen::Index i = 0; i < m.size(); ++i) (*m.load)[i] = 5 + 5 * std::sin(0.013 * m.time[i]);
  m.torque = PredictFriction(truth, LogSamples(m)).force;
  test::AddNoise(m, 0.01, 0, 5);
  const Estimate estimate = Identify(m, "load-map", {{"width", "1"}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_NEAR(estimate.metrics->rmse, 0.01, 0.01 * 0.05);
  const Identifier& identifier = FindIdentifier("load-map");
  const IdentifierInput input{
      Prepare(m, SelectMoving(m)), identifier.options.Read({{"width", "1"}}), {}};
  EXPECT_LT(HoldOut(identifier, input, 0.3).metrics->rmse, 0.01 * 1.15);

  m.load.reset();
  EXPECT_EQ(Identify(m, "load-map", {}).status, Status::bad_data);
}

TEST(WarmMaps, FindGainAndTimeConstantOfALawWhoseSlopeWarms) {
  // Eq. (27): F = (5 + 0.1 E) v + (15 + E) sign(v); E from these losses
  const Eigen::VectorXd velocity = test::AlternatingSpeeds(3600, 4);
  Measurements m = test::Record(1, velocity, Eigen::VectorXd::Zero(3600));
  const DiscreteThermal thermal = Discretise({-3, 600}, 1);
  RandomStream random({4, 0}, Stream::torque_noise);
  double energy = 0;
  for (Eigen::Index i = 0; i < 3600; ++i) {
    const double v = velocity[i], level = 15 + energy + (5 + 0.1 * energy) * std::abs(v);
    m.torque[i] = std::copysign(level, v) + 0.1 * random.Normal();
    energy = ThermalStep(thermal.gain, thermal.pole, energy, Loss(v, level));
  }
  const Estimate fixed = Identify(m, "energy-ml", {});
  const Estimate estimate = Identify(m, "lpv-energy", {});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  // without the slope the gain takes it up; with it the noise leaves 0.3 % (of k) and 0.4 % (tau)
  EXPECT_GT(std::abs(fixed.Find("thermal_gain")->value + 3), 0.1);
  EXPECT_NEAR(estimate.Find("thermal_gain")->value, -3, 4 * 0.003 * 3);
  EXPECT_NEAR(estimate.Find("thermal_time_constant")->value, 600, 4 * 0.004 * 600);
  EXPECT_FALSE(estimate.Find("thermal_gain")->interval95);
}

}  // namespace
}  // namespace warmjoint
