#include "scenarios/suite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "models/foundation/bad_input.h"
#include "models/foundation/serialize.h"
#include "scenarios/read_scenario.h"
#include "tests/support/folders.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr char kScenario[] = R"(question: Does it?
realizations: 7
seed: 5
scenario:
  friction: {law: coulomb, parameters: {coulomb: 15}}
  motion: {speeds: [0.1, 1], hold: 20}
  duration: 100
)";
constexpr char kIdentifiers[] = R"(identifiers:
  - {name: energy-als, label: em-50, options: {iterations: 50, gain_range: "-9:0"},
     claim: {source: "paper, Fig. 6", npe_continuous: 0.05}}
  - {name: nominal-ls}
)";
constexpr char kNoiseLadder[] = "ladder: {variable: noise.torque, unit: N.m, values: [0.1, 0.2]}\n";
constexpr char kMotionLadder[] = R"(ladder:
  variants:
    base: {}
    one speed: {motion.speeds: [0.5], duration: 50}
    travelling: {motion.hold: null, motion.travel: [0, 1]}
)";

Suite Read(const std::string& text) { return ParseSuite(text, "mine.yaml"); }

std::string Refusal(const std::string& text) {
  return test::RefusalOf([&] { Read(text); });
}

TEST(SuiteFile, NamesACommandAsAnIdentifier) {
  const std::string entry =
      "identifiers:\n  - {name: mine, command: \"python3 mine.py {recording} {estimate}\",\n"
      "     options: {time_limit: 5}}\n";
  const SuiteIdentifier mine = Read(kScenario + entry).identifiers.at(0);
  EXPECT_EQ(mine.name, kExternal);
  EXPECT_EQ(mine.label, "mine");
  EXPECT_EQ(mine.options.at("command"), "python3 mine.py {recording} {estimate}");
  EXPECT_EQ(mine.options.at("time_limit"), "5");
  EXPECT_THAT(Refusal(kScenario + std::string("identifiers:\n  - {name: mine, command: a,\n"
                                              "     options: {command: b}}\n")),
              HasSubstr(":9: identifiers.0.command is 'a'; it must be absent"));
}

TEST(SuiteFile, IsReadWhole) {
  const Suite suite = Read(std::string(kScenario) + kIdentifiers);
  EXPECT_EQ(suite.name, "mine");
  EXPECT_EQ(suite.question, "Does it?");
  EXPECT_EQ(suite.realizations, 7);
  EXPECT_EQ(suite.scenario.seed, 5);
  EXPECT_EQ(suite.scenario.duration, 100);
  EXPECT_EQ(suite.variants(), 1);
  ASSERT_EQ(suite.identifiers.size(), 2);
  const SuiteIdentifier expected{"energy-als",
                                 "em-50",
                                 {{"iterations", "50"}, {"gain_range", "-9:0"}},
                                 Claim{"paper, Fig. 6", {{"npe_continuous", 0.05}}}};
  EXPECT_EQ(WriteFields(suite.identifiers[0]), WriteFields(expected));
  EXPECT_EQ(suite.identifiers[1].label, "nominal-ls");
}

TEST(SuiteFile, WritesWhatItReads) {
  for (const char* ladder : {"", kNoiseLadder, kMotionLadder}) {
    const Suite suite = Read(std::string(kScenario) + ladder + kIdentifiers);
    const std::string yaml = SuiteToYaml(suite);
    const Suite back = Read(yaml);
    EXPECT_EQ(SuiteToYaml(back), yaml);
    ASSERT_EQ(back.variants(), suite.variants());
    for (int i = 0; i < suite.variants(); ++i) {
      EXPECT_EQ(ScenarioToYaml(VariantScenario(back, i)),
                ScenarioToYaml(VariantScenario(suite, i)));
    }
  }
}

TEST(SuiteFile, HasCompensatorsInPlaceOfIdentifiers) {
  const Suite suite =
      Read(std::string(kScenario) + "compensators:\n  - {name: heat, options: {gain: \"2\"}}\n");
  EXPECT_EQ(suite.contest, Contest::compensators);
  ASSERT_EQ(suite.identifiers.size(), 1);
  EXPECT_EQ(suite.identifiers[0].options.at("gain"), "2");
  const std::string yaml = SuiteToYaml(suite);
  EXPECT_EQ(yaml.find("\nidentifiers:"), std::string::npos) << yaml;
  EXPECT_EQ(SuiteToYaml(Read(yaml)), yaml);
}

TEST(SuiteFile, ClimbsTheValuesOfItsVariable) {
  const Suite suite = Read(std::string(kScenario) + kNoiseLadder + kIdentifiers);
  ASSERT_EQ(suite.variants(), 2);
  EXPECT_EQ(suite.ladder->unit, "N.m");
  EXPECT_EQ(suite.ladder->variants[1].name, "0.2");
  EXPECT_EQ(suite.ladder->variants[1].value, 0.2);
  EXPECT_EQ(VariantScenario(suite, 0).noise.torque, 0.1);
  EXPECT_EQ(VariantScenario(suite, 1).noise.torque, 0.2);
  EXPECT_EQ(VariantScenario(suite, 1).seed, 5);
}

TEST(SuiteFile, ChangesTheEntriesOfANamedVariant) {
  const Suite suite = Read(std::string(kScenario) + kMotionLadder + kIdentifiers);
  ASSERT_EQ(suite.variants(), 3);
  EXPECT_EQ(ScenarioToYaml(VariantScenario(suite, 0)), ScenarioToYaml(suite.scenario));
  EXPECT_THAT(VariantScenario(suite, 1).motion.speeds.list, testing::ElementsAre(0.5));
  EXPECT_EQ(VariantScenario(suite, 1).duration, 50);
  EXPECT_EQ(VariantScenario(suite, 2).motion.hold, 0);
}

TEST(SuiteFile, RefusesWhatCannotBe) {
  const std::string scenario = kScenario, identifiers = kIdentifiers;
  test::ExpectRefused(
      {{scenario, "mine.yaml", "identifiers"},
       {scenario + identifiers + "compensators:\n  - {name: none}\n", "mine.yaml", "identifiers"},
       {scenario + "compensators:\n  - {name: none}\n  - {name: fixed, label: none}\n",
        "mine.yaml:10", "'none'"},
       {identifiers, "mine.yaml", "'question'"},
       {scenario + "identifiers: []\n", "mine.yaml", "identifiers"},
       {scenario + "  seed: 5\n" + identifiers, "mine.yaml:8", "seed"},
       {scenario + identifiers + "  - {name: x, label: em-50}\n", "mine.yaml", "'em-50'"},
       {scenario + "  noize: {}\n" + identifiers, "mine.yaml:8", "noize"},
       {scenario + "ladder: {values: [1]}\n" + identifiers, "mine.yaml", "ladder.variable"},
       {scenario + "ladder: {unit: s}\n" + identifiers, "mine.yaml", "ladder"}},
      [](const std::string& text) { Read(text); });
}

TEST(SuiteFile, RefusesAVariantThatCannotRunBeforeAnythingRuns) {
  const std::string ladder = "ladder: {variants: {loud: {noise.torque: -1}}}\n";
  EXPECT_THAT(Refusal(std::string(kScenario) + ladder + kIdentifiers),
              testing::AllOf(HasSubstr(":8: variant 'loud'"), HasSubstr("noise.torque is '-1'")));
}

TEST(ShippedSuites, AreReadAndWrittenAsTheyAre) {
  int found = 0;
  for (const auto& entry : fs::directory_iterator(test::SourceFolder() / "scenarios/suites")) {
    if (entry.path().extension() != ".yaml") continue;
    ++found;
    const Suite suite = ReadSuite(entry.path().string());
    EXPECT_EQ(suite.name, entry.path().stem().string()) << "a suite is found by its file's name";
    EXPECT_GT(suite.question.size(), 20);
  }
  EXPECT_GE(found, 3);
}

}  // namespace
}  // namespace warmjoint
