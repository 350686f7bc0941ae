#include "scenarios/posterior.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scenarios/read_scenario.h"
#include "scenarios/scenario.h"
#include "tests/support/table1.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using nlohmann::json;
using testing::ElementsAre;

/// Table I with coulomb and the time constant known together.
const json kPosterior = {{"parameters", {"coulomb", "thermal_time_constant"}},
                         {"covariance", {{0.04, -1.2}, {-1.2, 400}}}};

Friction TableOneFriction() { return test::Table1().friction; }

TEST(Posterior, DrawsWithItsMeansAndCovariance) {
  const Posterior posterior = PosteriorFrom({Tree(kPosterior), "here"}, TableOneFriction());
  RandomStream random({1, 0}, Stream::test);
  const int n = 4000;
  Eigen::MatrixXd drawn(n, 2);
  for (int i = 0; i < n; ++i) {
    const Friction one = Draw(posterior, TableOneFriction(), random, {"here"});
    EXPECT_EQ(one.parameters.at("viscous"), 5);
    drawn.row(i) << one.parameters.at("coulomb"), one.thermal->time_constant;
  }
  // deviations 0.2 and 20; a mean scatters by one over the root of n of it, a variance by the root of
  // 2 / n, here 2.2 %; five of each
  const Eigen::RowVector2d mean = drawn.colwise().mean();
  EXPECT_NEAR(mean[0], 15, 5 * 0.2 / std::sqrt(n));
  EXPECT_NEAR(mean[1], 600, 5 * 20 / std::sqrt(n));
  const Eigen::Matrix2d covariance =
      (drawn.rowwise() - mean).transpose() * (drawn.rowwise() - mean) / (n - 1);
  const double scatter = 5 * std::sqrt(2.0 / n);
  EXPECT_NEAR(covariance(0, 0), 0.04, scatter * 0.04);
  EXPECT_NEAR(covariance(1, 1), 400, scatter * 400);
  EXPECT_NEAR(covariance(0, 1), -1.2, scatter * 0.2 * 20);
}

TEST(Posterior, KeepsWithinPhysicalBounds) {
  // a time constant known to 600 +- 600 is never drawn below 0
  const json wide = {{"parameters", {"thermal_time_constant"}}, {"covariance", {{360000}}}};
  const Posterior posterior = PosteriorFrom({Tree(wide), "here"}, TableOneFriction());
  RandomStream random({2, 0}, Stream::test);
  for (int i = 0; i < 200; ++i) {
    EXPECT_GT(Draw(posterior, TableOneFriction(), random, {"here"}).thermal->time_constant, 0);
  }
}

TEST(Posterior, RefusesWhatIsNoCovarianceOfTheFriction) {
  const auto read = [](const json& parameters, const json& covariance) {
    return PosteriorFrom(
        {Tree(json{{"parameters", parameters}, {"covariance", covariance}}), "here"},
        TableOneFriction());
  };
  EXPECT_THROW(read({"stribeck_velocity"}, {{1}}), BadInput);
  EXPECT_THROW(read({"viscous"}, {{-1}}), BadInput);
  EXPECT_THROW(read({"viscous", "coulomb"}, {{1}}), BadInput);
  EXPECT_THROW(read({"viscous", "coulomb"}, {{1, 0.5}, {0, 1}}), BadInput);
  EXPECT_THROW(read({"viscous", "coulomb"}, {{1, 2}, {2, 1}}), BadInput);
  EXPECT_THROW(read({"viscous"}, {{"wide"}}), BadInput);
  EXPECT_NO_THROW(read({"viscous", "coulomb"}, {{1, 1}, {1, 1}}));
}

TEST(Posterior, OfAnEstimateTakesWhatIsFriction) {
  const json estimate = {{"covariance",
                          {{"parameters", {"gravity_sin", "viscous", "coulomb"}},
                           {"matrix", {{9, 1, 1}, {1, 0.01, -0.02}, {1, -0.02, 0.25}}}}}};
  const Posterior posterior = PosteriorOfEstimate({Tree(estimate), "here"}, TableOneFriction());
  EXPECT_THAT(posterior.parameters, ElementsAre("viscous", "coulomb"));
  EXPECT_EQ(posterior.covariance, (Eigen::Matrix2d() << 0.01, -0.02, -0.02, 0.25).finished());
  EXPECT_THROW(
      PosteriorOfEstimate({Tree(json{{"covariance", nullptr}}), "here"}, TableOneFriction()),
      BadInput);
}

/// A scenario whose friction is that of an estimate file with 5 and 15 +- 1, drawn as `draw` says.
Scenario OfEstimate(const std::string& draw) {
  const ScratchDirectory scratch;
  std::ofstream(scratch.path() / "estimate.json")
      << R"({"friction": {"law": "viscous_coulomb", "parameters": {"viscous": 5, "coulomb": 15}},
             "covariance": {"parameters": ["coulomb"], "matrix": [[1]]}})";
  std::ofstream(scratch.path() / "scenario.yaml")
      << "friction: {estimate: estimate.json" << draw << "}\n"
      << "motion: {speeds: [1], hold: 2}\nduration: 20\n";
  return ReadScenario((scratch.path() / "scenario.yaml").string());
}

TEST(Posterior, AScenarioDrawsWhatItsEstimateLeavesOpen) {
  const Scenario scenario = OfEstimate(", draw: posterior");
  EXPECT_EQ(scenario.friction.parameters.at("coulomb"), 15);
  const double first = Realize(scenario, 0).friction.parameters.at("coulomb");
  const double second = Realize(scenario, 1).friction.parameters.at("coulomb");
  EXPECT_NE(first, 15);
  EXPECT_NE(first, second);
  EXPECT_EQ(Realize(scenario, 0).friction.parameters.at("viscous"), 5);

  // the scenario stands alone without the estimate, and draws the same
  const Scenario back = ParseScenario(ScenarioToYaml(scenario), "again.yaml");
  EXPECT_EQ(Realize(back, 0).friction.parameters.at("coulomb"), first);
}

TEST(Posterior, AScenarioTakesTheNumbersOfAnEstimateAsTheyAre) {
  const Scenario scenario = OfEstimate("");
  EXPECT_TRUE(scenario.draws.empty());
  EXPECT_EQ(scenario.friction.parameters.at("coulomb"), 15);
  EXPECT_THROW(OfEstimate(", draw: prior"), BadInput);
  EXPECT_THROW(OfEstimate(", draws: posterior"), BadInput);
}

}  // namespace
}  // namespace warmjoint
