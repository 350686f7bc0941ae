#include "tools/suite/trace_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/friction/thermal.h"

namespace warmjoint {
namespace {

using ::testing::ElementsAre;

constexpr double kStep = 1;  // s

/// The truth of k = -3 N.m/W, tau = 600 s at a step of 1 s.
Score TruthOfTable1() {
  const DiscreteThermal discrete = Discretise({-3, 600}, kStep);
  Score score;
  score.continuous = {{"thermal_gain", -3, 0, false, {}, 0},
                      {"thermal_time_constant", 600, 0, false, {}, 0}};
  score.discrete = {{"thermal_gain_discrete", discrete.gain, 0, false, {}, 0},
                    {"thermal_pole", discrete.pole, 0, false, {}, 0}};
  return score;
}

TEST(TraceTable, FollowsTheErrorOfBothPairs) {
  const std::vector<TraceEntry> trace{
      {0, {{"thermal_gain", -6}, {"thermal_time_constant", 600}}, 2.5},
      {7, {{"thermal_gain", -3}, {"thermal_time_constant", 600}}, 0.5},
  };
  const TraceTable table = MakeTraceTable(trace, TruthOfTable1(), kStep);
  EXPECT_THAT(table.columns, ElementsAre("iteration", "rmse", "npe_continuous", "npe_discrete",
                                         "thermal_gain", "thermal_time_constant"));
  EXPECT_THAT(table.values, ElementsAre(0, 2.5f, 1, 1, -6, 600, 7, 0.5f, 0, 0, -3, 600));
}

TEST(TraceTable, FindsTheContinuousPairOfADiscreteOne) {
  const DiscreteThermal discrete = Discretise({-3, 300}, kStep);
  const TraceTable table = MakeTraceTable(
      {{1, {{"thermal_gain_discrete", discrete.gain}, {"thermal_pole", discrete.pole}}, 1}},
      TruthOfTable1(), kStep);
  EXPECT_FLOAT_EQ(table.values[2], 0.5f) << "tau is half of its truth, k is right";
}

}  // namespace
}  // namespace warmjoint
