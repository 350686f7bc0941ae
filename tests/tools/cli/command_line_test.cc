#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/cli/run_program.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

TEST(CommandLine, HelpAndVersionEndWell) {
  const ProgramAnswer help = RunWarmjoint({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* name : {"list", "simulate", "check", "identify", "run", "compare"}) {
    EXPECT_THAT(help.out, HasSubstr(name));
    EXPECT_EQ(RunWarmjoint({name, "--help"}).status, 0);
  }
  const ProgramAnswer version = RunWarmjoint({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.out, HasSubstr("warmjoint 0."));
}

TEST(CommandLine, ListsEveryFamilyAsTextAndJson) {
  for (const char* family : {"laws", "identifiers", "robots", "suites"}) {
    const ProgramAnswer json = RunWarmjoint({"list", family, "--format", "json"});
    EXPECT_EQ(json.status, 0) << json.err;
    const auto members = nlohmann::json::parse(json.out);
    EXPECT_FALSE(members.empty()) << family;
    const ProgramAnswer text = RunWarmjoint({"list", family});
    EXPECT_EQ(text.status, 0);
    for (const auto& member : members) {
      EXPECT_THAT(text.out, HasSubstr(member.at("name").get<std::string>()));
    }
  }
}

TEST(CommandLine, ListsParametersOfLawsAndOptionsOfIdentifiers) {
  EXPECT_THAT(RunWarmjoint({"list", "laws"}).out, HasSubstr("coulomb_positive"));
  const auto identifiers =
      nlohmann::json::parse(RunWarmjoint({"list", "identifiers", "--format", "json"}).out);
  for (const auto& identifier : identifiers) {
    for (const auto& option : identifier.at("options")) {
      for (const char* key : {"name", "default", "allowed", "meaning"}) {
        EXPECT_TRUE(option.at(key).is_string()) << identifier.at("name") << " " << key;
      }
    }
  }
}

}  // namespace
}  // namespace warmjoint
