#include "tools/report/page/run_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenarios/suite.h"

namespace warmjoint::report {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::SizeIs;

Suite SuiteWith(const std::string& more) {
  return ParseSuite(
      "name: s\nquestion: q?\nscenario:\n  friction: {law: viscous_coulomb, "
      "parameters: {viscous: 5, coulomb: 15}, thermal: {thermal_gain: -0.6, "
      "thermal_time_constant: 450}}\n  motion: {speeds: [0.25, 1], hold: 7}\n  "
      "duration: 1200\n" +
          more + "identifiers: [{name: nominal-ls, options: {law: asymmetric}}]\n",
      "s.yaml");
}

TEST(RunWords, TellFrictionMotionAndLogOfASuite) {
  const std::vector<std::string> words = WhatWasSimulated(SuiteWith(""));
  EXPECT_THAT(words, SizeIs(4));
  for (const char* number : {"450 s", "0.25", "7", "1200 s", "viscous_coulomb", "falls"}) {
    EXPECT_THAT(words, Contains(HasSubstr(number)));
  }
}

TEST(RunWords, TellNoiseDisturbancesAndVariantsWhereThereAreAny) {
  const auto noisy = WhatWasSimulated(
      SuiteWith("  noise: {torque: 0.31}\n  disturbances: {outliers: {fraction: 0.1, size: 9}}\n"
                "ladder: {variable: duration, values: [900, 1800]}\n"));
  EXPECT_THAT(noisy, SizeIs(6));
  for (const char* word : {"0.31", "Disturbances", "duration", "900", "1800"}) {
    EXPECT_THAT(noisy, Contains(HasSubstr(word)));
  }
}

TEST(RunWords, TellWhatAnIdentifierIsWithItsOptions) {
  EXPECT_THAT(WhatItIs(SuiteWith("").identifiers[0]), HasSubstr("law=asymmetric"));
}

}  // namespace
}  // namespace warmjoint::report
