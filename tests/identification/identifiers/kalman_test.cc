#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/judging.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

Measurements TableOneRecording(std::uint64_t seed) {
  return test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, seed), 0.5, seed);
}

TEST(Kalman, ComesToTheMaximumLikelihood) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Measurements m = TableOneRecording(seed);
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
  int held = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Estimate estimate = test::Fitted("kalman", TableOneRecording(seed));
    for (const auto& [name, truth] :
         std::map<std::string, double>{{"viscous", 5},
                                       {"coulomb", 15},
                                       {"thermal_gain", -3},
                                       {"thermal_time_constant", 600}}) {
      const EstimatedParameter& parameter = *estimate.Find(name);
      ASSERT_TRUE(parameter.interval95) << estimate.message;
      const auto& [lower, upper] = *parameter.interval95;
      held += lower <= truth && truth <= upper;
      ++all;
    }
  }
  // 190 of 200 expected; the four parameters of one run are not independent: at worst 50 runs
  // count, deviation 2 sqrt(50 * 0.95 * 0.05) * 2 = 6; four of them
  EXPECT_GE(held, 190 - 25);
}

TEST(Kalman, GivesNoIntervalsAfterOnePass) {
  const Estimate once = test::Fitted("kalman", TableOneRecording(3), {{"passes", "1"}});
  EXPECT_THAT(once.message, HasSubstr("intervals need more than one pass"));
  // about twice the Cramer-Rao bound, 11 s of tau; five of these
  EXPECT_NEAR(once.Find("thermal_time_constant")->value, 600, 110);
  for (const EstimatedParameter& parameter : once.parameters) {
    EXPECT_FALSE(parameter.interval95) << parameter.name;
  }
}

TEST(Kalman, KnowsTheEnergyOnTheWay) {
  const Measurements m = TableOneRecording(7);
  const Estimate estimate = test::Fitted("kalman", m);
  const Prediction truth = PredictFriction(test::TableOne(), m);
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
  const Measurements m =
      test::RecordFriction(test::Cold(), 1, test::AlternatingSpeeds(3600, 5), 0.5, 5);
  const Estimate estimate = test::Fitted("kalman", m);
  EXPECT_EQ(estimate.status, Status::not_identifiable);
  EXPECT_THAT(estimate.message, HasSubstr("no warm-up can be seen"));
}

TEST(Kalman, AgreesWithRlsThatIsToldTheWarming) {
  const Measurements m = TableOneRecording(9);
  const Estimate filtered = test::Fitted("kalman", m);
  const auto text = [&](const char* name) { return std::to_string(filtered.Find(name)->value); };
  const Estimate told = test::Fitted("rls", m,
                                     {{"forgetting", "1"},
                                      {"thermal_gain", text("thermal_gain")},
                                      {"thermal_time_constant", text("thermal_time_constant")}});
  // rls takes the losses from the noisy torque: within the joint fit's deviation
  for (const char* name : {"viscous", "coulomb"}) {
    EXPECT_NEAR(filtered.Find(name)->value, told.Find(name)->value, *filtered.Find(name)->std)
        << name;
  }
}

}  // namespace
}  // namespace warmjoint
