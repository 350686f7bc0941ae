// Scenarios and suites that were made to crash, hang or fill what reads them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/bad_input.h"
#include "scenarios/read_scenario.h"
#include "scenarios/suite.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

const std::string kRest =
    "plant: ideal\nmotion: {speeds: [1], hold: 1}\nduration: 10\nsampling: {rate: 10}\n";
const std::string kFriction = "friction: {law: coulomb, parameters: {coulomb: 1}}\n";

/// What refuses the scenario, and, where it can be read, its motion.
std::string Refusal(const std::string& text, const Settings& settings = {}) {
  return test::RefusalOf([&] {
    const Scenario scenario = ParseScenario(text, "s.yaml", settings);
    RandomStream random({0, 0}, Stream::motion);
    PlanMotion(scenario.motion, scenario.duration, {0, 1}, random);
  });
}

TEST(HostileYaml, CyclesAreRefusedWithTheirLine) {
  EXPECT_THAT(Refusal(kRest + "friction: &a {law: viscous_coulomb, maps: [*a]}\n"),
              HasSubstr("s.yaml:5: nests deeper than 64 levels, or holds itself"));
  EXPECT_THAT(Refusal("&a {friction: *a}"), HasSubstr("holds itself"));
  EXPECT_THAT(Refusal(kRest + kFriction, {{"friction", "&a [*a]"}}), HasSubstr("holds itself"));
}

TEST(HostileYaml, ASecondDocumentIsNotPassedOver) {
  EXPECT_THAT(Refusal(kRest + kFriction + "---\nduration: 20\n"),
              HasSubstr("s.yaml:6: begins another document; keep one"));
}

TEST(HostileYaml, AliasesThatMultiplyAreCounted) {
  std::string laughs = "friction:\n  a0: &a0 [1,1,1,1,1,1,1,1,1]\n";
  for (int i = 1; i < 10; ++i) {
    laughs += fmt::format("  a{0}: &a{0} [*a{1},*a{1},*a{1},*a{1},*a{1},*a{1},*a{1},*a{1},*a{1}]\n",
                          i, i - 1);
  }
  EXPECT_THAT(Refusal(kRest + laughs), HasSubstr("more than 1000000 values"));
}

TEST(HostileYaml, TextThatIsNoUtf8IsRefusedWithItsLine) {
  EXPECT_THAT(Refusal(kRest + "friction: [\"\xCF\"]\n"), HasSubstr("s.yaml:5: byte"));
  EXPECT_THAT(Refusal(kRest + kFriction, {{"name", "\xCF"}}), HasSubstr("not UTF-8"));
}

TEST(HostileYaml, AKeyWithoutAValueIsNotTakenForItsDefault) {
  for (const char* nothing : {"~", "null", ""}) {
    EXPECT_THAT(Refusal(kRest + kFriction + fmt::format("noise: {}\n", nothing)),
                HasSubstr("s.yaml:6: the key 'noise' has no value"));
  }
}

TEST(HostileYaml, NamesThatWouldLeadElsewhereAreNoKeys) {
  for (const char* name : {"~x", "a.", "a/", "", "a.b"}) {
    const std::string text =
        kRest + fmt::format("friction: {{law: coulomb, \"{}\": {{uniform: [0, 1]}}}}\n", name);
    EXPECT_THAT(Refusal(text), HasSubstr("unknown key")) << name;
  }
  EXPECT_THAT(Refusal(kRest + "? [a, b]\n: 1\n"), HasSubstr("a key that is not a word"));
}

TEST(HostileYaml, PlansOfTooManySegmentsAreRefused) {
  const auto plan = [](const char* motion) {
    return Refusal("plant: ideal\nduration: 10\nsampling: {rate: 10}\n" + kFriction +
                   "motion: " + motion + "\n");
  };
  EXPECT_EQ(plan("{speeds: [1], hold: 1}"), "accepted");
  for (const char* motion : {"{speeds: [1], hold: 1e-9}", "{speeds: [1], hold: 1e-300}",
                             "{speeds: [1], travel: [0, 1e-9]}",
                             "{speeds: [1], hold: 1, rests: {run: 1e-300, rest: 1e-300}}",
                             "{phases: [{rest: 1e-300}]}"}) {
    EXPECT_THAT(plan(motion), HasSubstr("more than 1000000 segments")) << motion;
  }
}

TEST(HostileYaml, StepsOfTheEngineAreBounded) {
  EXPECT_THAT(Refusal("plant: mujoco\nrobot: r\njoint: j\nduration: 30\ntimestep: 1e-12\n" +
                      kFriction + "motion: {speeds: [1], hold: 1}\n"),
              HasSubstr("lengthen timestep"));
}

std::string SuiteRefusal(const std::string& entry) {
  return test::RefusalOf([&] {
    ParseSuite("question: which?\n" + entry +
                   "\nscenario:\n  plant: ideal\n  motion: {speeds: [1], hold: 1}\n  duration: 10\n"
                   "  sampling: {rate: 10}\n  " +
                   kFriction + "identifiers:\n  - {name: nominal-ls}\n",
               "s.yaml");
  });
}

TEST(HostileYaml, CountsAndSeedsHaveTheirBounds) {
  EXPECT_EQ(SuiteRefusal("realizations: 10000000"), "accepted");
  for (const char* count : {"0", "-1", "2147483648", "4294967297", "9223372036854775807", "1e9"}) {
    EXPECT_THAT(SuiteRefusal(std::string("realizations: ") + count),
                HasSubstr("a whole number from 1 to 10000000"))
        << count;
  }
  EXPECT_EQ(SuiteRefusal("seed: 18446744073709551615"), "accepted");
  EXPECT_THAT(SuiteRefusal("seed: -1"), HasSubstr("from 0 to 18446744073709551615"));
}

TEST(HostileYaml, LaddersHaveTheirBound) {
  std::string values;
  for (int i = 0; i < 2000; ++i) values += (i ? "," : "") + std::to_string(i + 1);
  EXPECT_THAT(SuiteRefusal("ladder: {variable: duration, values: [" + values + "]}"),
              HasSubstr("2000 variants; 1000 at most"));
}

}  // namespace
}  // namespace warmjoint
