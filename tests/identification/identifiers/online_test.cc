// Identifiers that take sample after sample.
#include <gmock/gmock.h>

#include <cmath>

#include "identification/forward/log_trajectory.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

TEST(Rls, IsNominalLsWhereItForgetsNothing) {
  const Measurements m =
      test::RecordFriction(test::Cold(), 1, test::AlternatingSpeeds(2000, 1, 300), 0.5, 1);
  const Estimate online = test::Fitted("rls", m, {{"forgetting", "1"}});
  const Estimate batch = test::Fitted("nominal-ls", m);
  for (const char* name : {"viscous", "coulomb"}) {
    // 1e-9: linear solve; the first doubt counts as 1e-8 of 1400 samples
    EXPECT_NEAR(online.Find(name)->value, batch.Find(name)->value, 1e-9 * 15) << name;
    EXPECT_NEAR(*online.Find(name)->std, *batch.Find(name)->std, 0.01 * *batch.Find(name)->std);
  }
}

TEST(Rls, FollowsFrictionThatWarms) {
  // settled, E = k W makes F = F0 / (1 - k |v|): near 0.5 rad/s the level has fallen by half
  const Measurements m = test::RecordHour(test::TableOne(), 2, 0.1);
  const Estimate online = test::Fitted("rls", m, {{"forgetting", "0.995"}});
  ASSERT_EQ(online.trace.size(), 50u);
  const double first = online.trace[1].parameters[1].second;
  const double last = online.trace[49].parameters[1].second;
  EXPECT_LT(last, first - 3);
}

TEST(Rls, TakesOffTheWarmingThatIsKnown) {
  const Measurements m = test::RecordHour(test::TableOne(), 3, 0.1);
  const Estimate online =
      test::Fitted("rls", m, {{"thermal_gain", "-3"}, {"thermal_time_constant", "600"}});
  // noise of 0.1 N.m over the last 1000 samples; 5 standard deviations
  EXPECT_NEAR(online.Find("viscous")->value, 5, 5 * 0.1 / std::sqrt(1000) / 0.26);
  EXPECT_NEAR(online.Find("coulomb")->value, 15, 5 * 0.1 / std::sqrt(1000) / 0.4);
  ASSERT_TRUE(online.friction);
  EXPECT_EQ(online.friction->thermal->gain, -3);
}

TEST(Rls, LetsIntervalsHoldWhereTheNoiseComesThroughTheHeat) {
  // the heat's share of the level's variance is a quarter here, and of the slope's little
  int held = 0;
  constexpr int kLogs = 400;
  for (std::uint64_t seed = 1; seed <= kLogs; ++seed) {
    const Measurements m =
        test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(1800, seed), 0.5, seed);
    const Estimate online =
        test::Fitted("rls", m, {{"thermal_gain", "-3"}, {"thermal_time_constant", "600"}});
    held += test::Holds(online, "coulomb", 15);
  }
  // 380 expected, binomial deviation 4.4; without the heat's share 355
  EXPECT_GE(held, 380 - 3 * 4.4);
}

TEST(Rls, TakesGravityOffTheHeat) {
  Measurements m = test::RecordHour(test::TableOne(), 4, 0);
  m.torque += 6 * m.position.array().sin().matrix();
  const Estimate online = test::Fitted("rls", m,
                                       {{"thermal_gain", "-3"},
                                        {"thermal_time_constant", "600"},
                                        {"gravity", "sincos"},
                                        {"forgetting", "1"}});
  // without noise all of it is linear: what is left is the first doubt, 1e-8 of 3600 samples
  EXPECT_NEAR(online.Find("viscous")->value, 5, 1e-6);
  EXPECT_NEAR(online.Find("coulomb")->value, 15, 1e-6);
}

TEST(Kalman, ComesToTheMaximumLikelihood) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Measurements m = test::RecordHour(test::TableOne(), seed);
    const Estimate filtered = test::Fitted("kalman", m);
    const Estimate likely = test::Fitted("energy-ml", m);
    ASSERT_EQ(filtered.status, Status::ok) << filtered.message;
    for (const EstimatedParameter& parameter : likely.parameters) {
      // the passes end where one moves less than a tenth of a deviation
      const EstimatedParameter& ours = *filtered.Find(parameter.name);
      EXPECT_NEAR(ours.value, parameter.value, 0.1 * *parameter.std) << parameter.name;
      EXPECT_NEAR(*ours.std, *parameter.std, 0.05 * *parameter.std) << parameter.name;
    }
  }
}

TEST(Kalman, HoldsTheTruthInItsIntervals) {
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Estimate estimate = test::Fitted("kalman", test::RecordHour(test::TableOne(), seed));
    for (const auto& [name, truth] : test::TruthOf(test::TableOne())) {
      ASSERT_TRUE(estimate.Find(name)->interval95) << estimate.message;
      held += test::Holds(estimate, name, truth);
    }
  }
  // 190 of 200 expected; the four parameters of one run are not independent: at worst 50 runs
  // count, deviation 2 sqrt(50 * 0.95 * 0.05) * 2 = 6; four of them
  EXPECT_GE(held, 190 - 25);
}

TEST(Kalman, GivesNoIntervalsAfterOnePass) {
  const Estimate once =
      test::Fitted("kalman", test::RecordHour(test::TableOne(), 3), {{"passes", "1"}});
  EXPECT_THAT(once.message, HasSubstr("intervals need more than one pass"));
  // about twice the Cramer-Rao bound, 11 s of tau; five of these
  EXPECT_NEAR(once.Find("thermal_time_constant")->value, 600, 110);
  for (const EstimatedParameter& parameter : once.parameters) {
    EXPECT_FALSE(parameter.interval95) << parameter.name;
  }
}

TEST(Kalman, KnowsTheEnergyOnTheWay) {
  const Measurements m = test::RecordHour(test::TableOne(), 7);
  const Estimate estimate = test::Fitted("kalman", m);
  const Prediction truth = PredictFriction(test::TableOne(), LogSamples(m));
  ASSERT_EQ(estimate.trace.size(), 50u);
  for (const TraceEntry& entry : estimate.trace) {
    if (entry.iteration < 720 || entry.iteration == m.size()) continue;
    EXPECT_EQ(entry.parameters.back().first, "energy");
    // E and the Coulomb level share what is not yet known: after 12 min, a tenth of a newton metre
    // each way for five deviations of 0.5 / sqrt(720)
    EXPECT_NEAR(entry.parameters.back().second, truth.energy[entry.iteration], 1)
        << entry.iteration;
  }
}

TEST(Kalman, SaysThatAColdJointShowsNoWarming) {
  const Estimate estimate = test::Fitted("kalman", test::RecordHour(test::Cold(), 5));
  EXPECT_EQ(estimate.status, Status::not_identifiable);
  EXPECT_THAT(estimate.message, HasSubstr("no warm-up can be seen"));
}

}  // namespace
}  // namespace warmjoint
