#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/cli/run_program.h"

namespace warmjoint {
namespace {

using testing::HasSubstr;

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

TEST(CommandLine, RefusesWhatItDoesNotKnowWithTheNearest) {
  struct Case {
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::vector<Case> cases{
      {{}, "--help"},
      {{"idntify", "x.csv"}, "there is no 'idntify' here; did you mean 'identify'?"},
      {{"run", "x.yaml", "--sed", "3"}, "there is no '--sed' here; did you mean '--seed'?"},
      {{"run", "x.yaml"}, "--output is required"},
      {{"run", "x.yaml", "-o", "r", "--jobs", "0"}, "--jobs"},
      {{"run", "x.yaml", "-o", "r", "--seed", "many"}, "--seed"},
      {{"list", "lawss"}, "lawss"},
      {{"compare", "a", "--format", "xml"}, "xml"},
      {{"compare"}, "RUN is required"},
      {{"compare", "no-such-run"}, "no-such-run: is no run directory"},
      {{"check", "no-such.csv"}, "no-such.csv"},
      {{"identify", "no-such.csv", "--identifier", "energy-mll"}, "did you mean 'energy-ml'?"},
      {{"identify", "no-such.csv", "--set", "lw=coulomb"}, "lw"},
      {{"identify", "no-such.csv", "--holdout", "1.5"}, "--holdout"},
      {{"identify", "no-such.csv", "--map", "torque"}, "--map"},
      {{"simulate", "no-such.yaml", "-o", "d"}, "no-such.yaml"},
  };
  for (const Case& one : cases) {
    const ProgramAnswer answer = RunWarmjoint(one.arguments);
    EXPECT_EQ(answer.status, 2) << one.message;
    EXPECT_THAT(answer.err, HasSubstr(one.message));
    EXPECT_EQ(answer.out, "") << one.message;
  }
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

TEST(CommandLine, ListsWhatAFrictionCanCarryBesideItsLaw) {
  const std::string text = RunWarmjoint({"list", "laws"}).out;
  for (const char* part :
       {"thermal.second", "load_gain", "level_per_temperature", "viscous_per_energy",
        "quantities: position, motor_position, velocity, energy, load",
        "kernels: normalised, plain", "factors: one, direction, velocity"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  const auto laws = nlohmann::json::parse(RunWarmjoint({"list", "laws", "--format", "json"}).out);
  EXPECT_EQ(laws.back().at("name"), "maps");
  EXPECT_EQ(laws.back().at("quantities").size(), 5);
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

TEST(CommandLine, ListsTheNameOfOneMemberAlone) {
  EXPECT_EQ(RunWarmjoint({"list", "laws", "coulomb", "--format", "names"}).out, "coulomb\n");
  EXPECT_EQ(RunWarmjoint({"list", "laws", "colomb", "--format", "names"}).status, 2);
}

}  // namespace
}  // namespace warmjoint
