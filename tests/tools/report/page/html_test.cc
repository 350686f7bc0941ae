#include "tools/report/page/html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace warmjoint::report {
namespace {

using testing::HasSubstr;

TEST(Html, ThePolicyAdmitsTheGivenTextsAlone) {
  // sha256 of "abc" (FIPS 180-4's example) in base 64
  const std::string abc = "'sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0='";
  const std::string policy = SecurityPolicy({"abc"}, {});
  EXPECT_THAT(policy, HasSubstr("default-src 'none'; img-src data:;"));
  EXPECT_THAT(policy, HasSubstr("style-src " + abc + "; script-src 'none';"));
  EXPECT_THAT(SecurityPolicy({}, {"abc", "abc"}), HasSubstr("script-src " + abc + " " + abc + ";"));
}

TEST(Html, PrintsUnitsAndNamesAsBooksDo) {
  EXPECT_EQ(InPrint("FPE (N.m)^2"), "FPE (N·m)²");
  EXPECT_EQ(InPrint("861 us"), "861 µs");
  EXPECT_EQ(InPrint("the Cramer-Rao bound is used"), "the Cramér-Rao bound is used");
}

}  // namespace
}  // namespace warmjoint::report
