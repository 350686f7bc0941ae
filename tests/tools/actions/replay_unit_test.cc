#include "tools/actions/replay_unit.h"

#include <gtest/gtest.h>

#include "scenarios/suite.h"
#include "sim/plant/plant.h"
#include "tools/suite/prepare_identifiers.h"
#include "tools/suite/run_realization.h"

namespace warmjoint {
namespace {

constexpr const char* kSuite = R"(name: little
question: Which?
realizations: 3
seed: 9
scenario:
  friction: {law: viscous_coulomb, parameters: {viscous: 5, coulomb: 15}, thermal: {thermal_gain: -0.6, thermal_time_constant: 100}}
  motion: {speeds: [0.5, 1], hold: 5}
  duration: 600
ladder: {variable: noise.torque, values: [0.1, 0.25]}
identifiers: [{name: energy-ml}, {name: external, label: mine, options: {command: "true {recording} {estimate}"}}]
)";

TEST(ReplayUnit, GivesTheAnswerThatTheRunHad) {
  const Suite suite = ParseSuite(kSuite, "little.yaml");
  const Unit unit{1, 2};
  const Replayed replayed = ReplayUnit(suite, unit, suite.identifiers[0]);
  const auto identifiers = PrepareIdentifiers({suite.identifiers[0]}, {"little.yaml"});
  const RealizationResult run =
      RunRealization(MakeBench(VariantScenario(suite, 1)), identifiers, unit, RecordingKeeper{""});
  const Result& result = run.realization.results.at(0);
  ASSERT_EQ(result.status, "ok");
  EXPECT_EQ(replayed.estimate.metrics->rmse, result.metrics->rmse);
  EXPECT_EQ(replayed.estimate.parameters.at(0).value, result.score->continuous.at(0).estimate);
}

TEST(ReplayUnit, RunsNoCommandFromOutside) {
  const Suite suite = ParseSuite(kSuite, "little.yaml");
  EXPECT_THROW(ReplayUnit(suite, {0, 0}, suite.identifiers[1]), BadInput);
}

TEST(ReplayCommand, NamesVariantAndRealization) {
  const Suite suite = ParseSuite(kSuite, "little.yaml");
  EXPECT_EQ(ReplayCommand(suite, {1, 2}, "my run"),
            "warmjoint simulate --from 'my run' --variant 0.25 --realization 2 -o replay");
}

}  // namespace
}  // namespace warmjoint
