#include <gmock/gmock.h>

#include "tests/support/judging.h"

namespace warmjoint {
namespace {

TEST(Rls, IsNominalLsWhereItForgetsNothing) {
  FrictionDescription friction = test::TableOne();
  friction.thermal.reset();
  const Measurements m =
      test::RecordFriction(friction, 1, test::AlternatingSpeeds(2000, 1, 300), 0.5, 1);
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
  const Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 2), 0.1, 2);
  const Estimate online = test::Fitted("rls", m, {{"forgetting", "0.995"}});
  ASSERT_EQ(online.trace.size(), 50u);
  const double first = online.trace[1].parameters[1].second;
  const double last = online.trace[49].parameters[1].second;
  EXPECT_LT(last, first - 3);
}

TEST(Rls, TakesOffTheWarmingThatIsKnown) {
  const Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 3), 0.1, 3);
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
  for (int seed = 1; seed <= kLogs; ++seed) {
    const Measurements m = test::RecordFriction(
        test::TableOne(), 1, test::AlternatingSpeeds(1800, static_cast<std::uint64_t>(seed)), 0.5,
        static_cast<std::uint64_t>(seed));
    const Estimate online =
        test::Fitted("rls", m, {{"thermal_gain", "-3"}, {"thermal_time_constant", "600"}});
    const auto& [lower, upper] = *online.Find("coulomb")->interval95;
    held += lower <= 15 && 15 <= upper;
  }
  // 380 expected, binomial deviation 4.4; without the heat's share 355
  EXPECT_GE(held, 380 - 3 * 4.4);
}

TEST(Rls, TakesGravityOffTheHeat) {
  Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 4), 0, 4);
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

}  // namespace
}  // namespace warmjoint
