#include "scenarios/realize.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenarios/read_scenario.h"
#include "tests/support/table1.h"

namespace warmjoint {
namespace {

Scenario Drawn() {
  return WithSettings(test::Table1(),
                      {{"friction.parameters.viscous", "{uniform: [4, 6]}"},
                       {"friction.thermal.thermal_time_constant", "{log_uniform: [100, 1000]}"},
                       {"initial_energy", "{normal: [-1, 0.5]}"}});
}

TEST(Realize, LeavesAScenarioWithoutDrawsAsItIs) {
  EXPECT_EQ(ScenarioToYaml(Realize(test::Table1(), 5)), ScenarioToYaml(test::Table1()));
}

TEST(Realize, DrawsEachTruthFromItsDistribution) {
  // 500 draws; sd of the means: 0.577 / sqrt(n), 0.665 / sqrt(n), 0.5 / sqrt(n); bounds 5 sd
  const int n = 500;
  double viscous = 0, log_time = 0, energy = 0;
  for (int i = 0; i < n; ++i) {
    const Scenario one = Realize(Drawn(), static_cast<std::uint64_t>(i));
    EXPECT_TRUE(one.draws.empty());
    EXPECT_EQ(one.friction.parameters.at("coulomb"), 15);
    const double kv = one.friction.parameters.at("viscous");
    EXPECT_TRUE(kv >= 4 && kv < 6) << kv;
    viscous += kv / n;
    log_time += std::log(one.friction.thermal->time_constant) / n;
    energy += one.initial_energy / n;
  }
  const double root = std::sqrt(double(n));
  EXPECT_NEAR(viscous, 5, 5 * 0.577 / root);
  EXPECT_NEAR(log_time, (std::log(100) + std::log(1000)) / 2, 5 * 0.665 / root);
  EXPECT_NEAR(energy, -1, 5 * 0.5 / root);
}

TEST(Realize, RepeatsTheTruthOfARealization) {
  EXPECT_EQ(ScenarioToYaml(Realize(Drawn(), 3)), ScenarioToYaml(Realize(Drawn(), 3)));
  EXPECT_NE(ScenarioToYaml(Realize(Drawn(), 3)), ScenarioToYaml(Realize(Drawn(), 4)));
}

}  // namespace
}  // namespace warmjoint
