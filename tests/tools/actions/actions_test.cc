// The heat that a joint starts with, project files, and realizations that are simulated again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/serialize.h"
#include "scenarios/suite.h"
#include "sim/plant/plant.h"
#include "tests/support/refusal.h"
#include "tests/tools/scratch_directory.h"
#include "tools/identify/carried_heat.h"
#include "tools/identify/recording_source.h"
#include "tools/suite/prepare_identifiers.h"
#include "tools/suite/run_realization.h"

namespace warmjoint {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;
using ::testing::ThrowsMessage;

Friction Warm(bool two_stages) {
  Friction friction;
  friction.law = "viscous_coulomb";
  friction.parameters = {{"viscous", 5}, {"coulomb", 15}};
  friction.thermal = Thermal{-3, 600};
  if (two_stages) friction.second_thermal = Thermal{-1, 60};
  return friction;
}

class InitialEnergyOfAFile : public testing::Test {
 protected:
  std::string Estimate(const std::string& end) const {
    const std::string file = scratch.path() / "estimate.json";
    WriteWholeFile(file, R"({"status": "ok")" + end + "}");
    return file;
  }
  ScratchDirectory scratch;
};

TEST_F(InitialEnergyOfAFile, IsNoneWhereCold) {
  EXPECT_TRUE(InitialEnergies("cold", Warm(true), "no such file").empty());
}

TEST_F(InitialEnergyOfAFile, IsThatAtTheEndAsANumberOrWithItsInterval) {
  const std::string number = Estimate(R"(, "state_end": {"energy": -2.5})");
  EXPECT_THAT(InitialEnergies("end", Warm(false), number), ElementsAre(-2.5));
  const std::string interval = Estimate(
      R"(, "state_end": {"energy": {"value": -2.5, "std": 0.1, "interval95": [-2.7, -2.3]},
                         "second_energy": -0.5})");
  EXPECT_THAT(InitialEnergies("end", Warm(true), interval), ElementsAre(-2.5, -0.5));
}

TEST_F(InitialEnergyOfAFile, AtTheEndIsRefusedWhereTheFileHasNone) {
  const auto refuses = [&](const std::string& end, bool two_stages, const char* says) {
    const std::string file = Estimate(end);
    EXPECT_THAT([&] { InitialEnergies("end", Warm(two_stages), file); },
                ThrowsMessage<BadInput>(AllOf(HasSubstr("estimate.json"), HasSubstr(says))));
  };
  refuses("", false, "has no state_end");
  refuses(R"(, "state_end": {})", false, "no energy");
  refuses(R"(, "state_end": {"energy": -1})", true, "no second_energy");
  refuses(R"(, "state_end": {"energy": "hot"})", false, "state_end.energy");
}

TEST_F(InitialEnergyOfAFile, SettledIsTheClosedForm) {
  // E = k v F0 / (1 - k v), F0 = 5 v + 15
  const double v = 0.2, settled = -3 * v * (5 * v + 15) / (1 + 3 * v);
  const std::vector<double> energies = InitialEnergies("settled:0.2", Warm(false), "a file");
  ASSERT_EQ(energies.size(), 1U);
  EXPECT_NEAR(energies[0], settled, 1e-9);
}

TEST(ProjectFile, HoldsTheOptionsThatDescribeALog) {
  const Project project = ParseProject(
      "map: {time: t_s, velocity: }\nunit: {position: deg}\nscale: {torque: -1}\nwrap: 360\n"
      "columns: [a, b]\nrate: 50\n"
      "joint: linear\ngear: 50\ntrim: 0.2\nshortest_hold: 1\n",
      "warmjoint.yaml");
  EXPECT_THAT(project.map, ElementsAre(Pair("time", "t_s"), Pair("velocity", "")));
  EXPECT_THAT(project.unit, ElementsAre(Pair("position", "deg")));
  EXPECT_THAT(project.scale, ElementsAre(Pair("torque", -1)));
  EXPECT_EQ(project.wrap, 360);
  EXPECT_EQ(project.joint, JointKind::linear);
  EXPECT_EQ(project.gear, 50);
  EXPECT_EQ(project.trim, 0.2);
  EXPECT_EQ(project.shortest_hold, 1);
  EXPECT_THAT(project.columns, ElementsAre("a", "b"));
  EXPECT_EQ(project.rate, 50);
  EXPECT_EQ(WriteFields(project).size(), 10u);
  EXPECT_EQ(WriteFields(ParseProject("gear: 2\n", "")), Tree({{"gear", 2.0}}));
}

TEST(ProjectFile, RefusesWhatItDoesNotKnowAndWhatRuns) {
  const std::string first = "warmjoint.yaml:1", second = "warmjoint.yaml:2",
                    file = "warmjoint.yaml";
  test::ExpectRefused(
      {{"gear: 2\nidentifier: \"mine=sh {recording} {estimate}\"\n", second, "'identifier'"},
       {"command: touch P\n", first, "'command'"},
       {"set:\n  command: x\n", file, "'set'"},
       {"joint: rotary\ngaer: 50\n", second, "'gear'"},
       {"map: {torqe: f}\n", first, "'torque'"},
       {"unit: {position: dgr}\n", first, "position"},
       {"joint: prismatic\n", first, "joint is 'prismatic'"},
       {"gear: 0\n", first, "gear"},
       {"gear: .inf\n", first, "gear"},
       {"wrap: -1\n", first, "wrap"},
       {"scale: {torque: up}\n", first, "scale.torque"},
       {"- gear\n", file, "list"},
       {"", file, "nothing"},
       {"map: &a {time: *a}\n", file, "itself"}},
      [](const std::string& text) { ParseProject(text, "warmjoint.yaml"); });
}

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
  const RunUnit unit{1, 2};
  const Replayed replayed = ReplayUnit(suite, unit, suite.identifiers[0]);
  const auto identifiers = PrepareIdentifiers({suite.identifiers[0]}, {"little.yaml"});
  const RealizationResult run =
      RunRealization(MakeBench(VariantScenario(suite, 1)), identifiers, unit, "");
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
