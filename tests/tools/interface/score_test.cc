#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/score.h>

#include <cmath>

#include "tests/tools/cli/table_one_yaml.h"

namespace warmjoint::api {
namespace {

TEST(Score, GivesHandWorkedFigures) {
  // errors 1, -1, 1, -1 around measured values of mean 0
  const Metrics metrics = ComputeMetrics({2, -2, 2, -2}, {1, -1, 1, -1}, 1);
  EXPECT_EQ(metrics.n, 4);
  EXPECT_DOUBLE_EQ(metrics.rmse, 1);
  EXPECT_DOUBLE_EQ(metrics.mae, 1);
  EXPECT_DOUBLE_EQ(metrics.fit, 50);                       // 100 (1 - 2/4)
  EXPECT_DOUBLE_EQ(metrics.fpe, (1 + 0.25) / (1 - 0.25));  // V = 1, d/n = 1/4
  EXPECT_DOUBLE_EQ(metrics.effective_parameters, 1);
  // sqrt(0.1^2 + 0.2^2)
  EXPECT_DOUBLE_EQ(NormalisedParameterError({11, 4}, {10, 5}), std::sqrt(0.05));
}

TEST(Score, CountsWhatIsNotEstimatedAsZero) {
  const Simulation simulation = SimulateText(TableOneYaml(600));
  Estimate estimate;
  estimate.parameters = {{"viscous", 5, "", 0.1, {{4.9, 5.1}}}, {"coulomb", 30, "", {}, {}}};
  const Score score = ScoreEstimate(estimate, simulation.recording, simulation.truth);
  ASSERT_EQ(score.continuous.size(), 4u);
  EXPECT_EQ(score.continuous[0].name, "viscous");
  EXPECT_EQ(score.continuous[0].covered, true);
  EXPECT_EQ(score.continuous[1].covered, std::nullopt);
  EXPECT_FALSE(score.continuous[2].estimated);
  EXPECT_GT(score.continuous[0].bound, 0);
  // 0 for viscous, 1 for coulomb, 1 for each of the two thermal ones
  EXPECT_DOUBLE_EQ(score.npe_continuous, std::sqrt(3));
}

TEST(Score, RefusesWhatDoesNotBelongTogether) {
  const Simulation simulation = SimulateText(TableOneYaml(600));
  Truth other = simulation.truth;
  other.force.pop_back();
  EXPECT_THROW(ScoreEstimate({}, simulation.recording, other), BadInput);
  EXPECT_THROW(NormalisedParameterError({1}, {0}), BadInput);
  EXPECT_THROW(NormalisedParameterError({1, 2}, {1}), BadInput);
  EXPECT_THROW(ComputeMetrics({}, {}, 0), BadInput);
  EXPECT_THROW(ComputeMetrics({1, 2}, {1, 2}, 2), BadInput);
}

}  // namespace
}  // namespace warmjoint::api
