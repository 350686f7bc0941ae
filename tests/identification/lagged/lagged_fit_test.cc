#include "identification/lagged/lagged_fit.h"

#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <cmath>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/lagged/lag_search.h"
#include "identification/lagged/seen_lag.h"
#include "models/foundation/low_pass.h"
#include "models/foundation/random_stream.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

using Eigen::VectorXd;

constexpr double kLag = 1.7;  // s

/// Table I's joint at 1 Hz behind a lag, with or without warming; noise: N.m.
Measurements Lagging(double lag, double noise, std::optional<Thermal> thermal = Thermal{-3, 600}) {
  Friction joint = test::TableOne();
  joint.thermal = thermal;
  const VectorXd velocity = test::AlternatingSpeeds(2400, 3);
  Measurements m = test::Record(1, velocity, velocity);
  for (Eigen::Index i = 1; i < m.size(); ++i) m.position[i] = m.position[i - 1] + velocity[i - 1];
  m.torque = PredictFriction(joint, m, {}).force;
  if (lag > 0) m.torque = LowPass(m.time, m.torque, lag);
  RandomStream random({29, 0}, Stream::test);
  for (double& torque : m.torque) torque += noise * random.Normal();
  return m;
}

Estimate Identified(const std::string& name, const Measurements& m) {
  const Identifier& identifier = FindIdentifier(name);
  return IdentifyUnjudged(identifier,
                          {Prepare(m), identifier.options.Read({{"torque_lag", "estimated"}}), {}});
}

TEST(TorqueLag, OfAnExactRecordingIsFoundWithTheFrictionBehindIt) {
  const Estimate warm = Identified("energy-ml", Lagging(kLag, 0));
  ASSERT_EQ(warm.status, Status::ok) << warm.message;
  // the search ends within 1e-6 of T; the heat is Eq. (22)'s
  EXPECT_NEAR(warm.Find("torque_lag")->value, kLag, 1e-5 * kLag);
  EXPECT_NEAR(warm.Find("viscous")->value, 5, 1e-4);
  EXPECT_NEAR(warm.Find("coulomb")->value, 15, 1e-4);
  EXPECT_NEAR(warm.Find("thermal_gain")->value, -3, 1e-4);
  EXPECT_NEAR(warm.Find("thermal_time_constant")->value, 600, 0.05);
}

TEST(TorqueLag, IsFoundByALawWithoutWarming) {
  const Estimate cold = Identified("nominal-ls", Lagging(kLag, 0, std::nullopt));
  ASSERT_EQ(cold.status, Status::ok) << cold.message;
  EXPECT_NEAR(cold.Find("torque_lag")->value, kLag, 1e-5 * kLag);
  // 1e-6 of T moves the torque by 1e-6 of the largest drop, 40 N.m, at most
  EXPECT_NEAR(cold.Find("coulomb")->value, 15, 4e-5);
}

TEST(TorqueLag, IsFoundWhereTheFitWithoutItGoesAstray) {
  // a lag of 0.8 s in holds of 2 s leaves torque of the wrong sign in a third of the samples
  Friction joint = test::TableOne();
  const VectorXd speeds = test::AlternatingSpeeds(4200, 11);
  VectorXd velocity(21000);
  for (Eigen::Index i = 0; i < velocity.size(); ++i) velocity[i] = speeds[i / 5];
  Measurements m = test::Record(0.02, velocity, velocity);
  for (Eigen::Index i = 1; i < m.size(); ++i) {
    m.position[i] = m.position[i - 1] + 0.02 * velocity[i - 1];
  }
  m.torque = LowPass(m.time, PredictFriction(joint, m, {}).force, 0.8);
  RandomStream random({31, 0}, Stream::test);
  for (double& torque : m.torque) torque += 0.3 * random.Normal();
  const Estimate estimate = Identified("energy-ml", m);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_NEAR(estimate.Find("torque_lag")->value, 0.8, 4 * *estimate.Find("torque_lag")->std);
  EXPECT_NEAR(estimate.Find("coulomb")->value, 15, 4 * *estimate.Find("coulomb")->std);
}

TEST(TorqueLag, IsNotFittedWhereTheTorqueShowsNone) {
  for (const char* name : {"energy-ml", "nominal-ls"}) {
    const std::optional<Thermal> thermal =
        std::string(name) == "energy-ml" ? std::optional(Thermal{-3, 600}) : std::nullopt;
    const Measurements m = Lagging(0, 0.5, thermal);
    const Estimate asked = Identified(name, m);
    const Identifier& identifier = FindIdentifier(name);
    const Estimate plain = IdentifyUnjudged(identifier, {Prepare(m), identifier.options, {}});
    ASSERT_EQ(asked.status, Status::ok) << asked.message;
    EXPECT_EQ(asked.Find("torque_lag"), nullptr);
    EXPECT_EQ(asked.Find("coulomb")->value, plain.Find("coulomb")->value);
    EXPECT_EQ(asked.Find("coulomb")->interval95, plain.Find("coulomb")->interval95);
  }
}

TEST(TorqueLag, LeavesTheVerdictNothingToFind) {
  const Measurements m = Lagging(kLag, 0.5);
  const Identifier& identifier = FindIdentifier("energy-ml");
  EXPECT_EQ(
      IdentifyAndJudge(identifier,
                       {Prepare(m), identifier.options.Read({{"torque_lag", "estimated"}}), {}})
          .status,
      Status::ok);
  EXPECT_NE(IdentifyAndJudge(identifier, {Prepare(m), identifier.options, {}}).status, Status::ok);
}

TEST(TorqueLag, IsRefusedBesideOptionsThatRuleItOut) {
  const Identifier& identifier = FindIdentifier("nominal-ls");
  EXPECT_EQ(
      IdentifyUnjudged(identifier,
                       {Prepare(Lagging(kLag, 0.5)),
                        identifier.options.Read({{"torque_lag", "estimated"}, {"loss", "huber"}}),
                        {}})
          .status,
      Status::bad_data);
}

TEST(FindLag, RefinesTheLeastSquaresAndKnowsTheEndsOfItsRange) {
  const LagRange range{0.01, 10};
  const auto valley = [](double at) {
    return [at](double lag) { return 1 + std::pow(std::log(lag / at), 2); };
  };
  EXPECT_NEAR(*FindLag(range, valley(0.37)), 0.37, 1e-5);
  EXPECT_FALSE(FindLag(range, valley(1e-4)));
  EXPECT_FALSE(FindLag(range, valley(1e3)));
  EXPECT_FALSE(FindLag(range, [](double) { return kInfinity; }));
}

TEST(SeenLag, IsSeldomSeenInNoiseOfAnyColour) {
  // 300 logs of 30 runs: the level is one in a thousand for a lag above 0
  auto runs = std::make_shared<KeptRuns>();
  for (Eigen::Index r = 0; r < 30; ++r) runs->runs.push_back({20 * r, 20 * r + 20});
  runs->time = VectorXd::LinSpaced(600, 0, 599);
  for (Eigen::Index i = 0; i < 600; ++i) runs->samples.push_back(i);
  const LaggedRows rows(runs, 2);
  VectorXd torque(600);
  for (Eigen::Index i = 0; i < 600; ++i) torque[i] = i / 20 % 2 ? 15 : -15;
  int seen = 0;
  for (std::uint64_t log = 0; log < 300; ++log) {
    RandomStream random({61, log}, Stream::test);
    VectorXd noise(600);
    double held = 0;
    for (double& value : noise) value = held = 0.9 * held + random.Normal();
    seen += LookForLag(rows, torque, noise).IsSeen();
  }
  // more than 3 of 300 at 1 in 1000 happen in 0.03 % of the cases
  EXPECT_LE(seen, 3);
}

}  // namespace
}  // namespace warmjoint
