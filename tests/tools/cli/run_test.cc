// Runs of a suite: the same results whatever happens on the way.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/cli/table_one_yaml.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using testing::HasSubstr;
using testing::Not;

/// 40 realizations of Algorithm 1 and least squares: long enough to be hit in the middle.
std::string SuiteText() {
  return TableOneSuite(40,
                       "  - {name: nominal-ls}\n"
                       "  - {name: energy-em, label: em, options: {iterations: 20},\n"
                       "     claim: {source: us, rmse: 0.5}}\n");
}

class Run : public testing::Test {
 protected:
  void SetUp() override { WriteWholeFile(suite_, SuiteText()); }

  std::string Directory(const std::string& name) const { return scratch_.path() / name; }

  std::vector<std::string> Command(const std::string& directory,
                                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command{"run", suite_, "-o", Directory(directory)};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }

  std::string Results(const std::string& directory) const {
    return ReadWholeFile(Directory(directory) + "/results.csv");
  }

  ScratchDirectory scratch_;
  std::string suite_ = scratch_.path() / "little.yaml";
};

TEST_F(Run, GivesTheSameBytesForAnyNumberOfThreads) {
  ASSERT_EQ(RunWarmjoint(Command("one", {"--jobs", "1"})).status, 0);
  ASSERT_EQ(RunWarmjoint(Command("two", {"--jobs", "2"})).status, 0);
  EXPECT_EQ(Results("one"), Results("two"));
  EXPECT_EQ(ReadWholeFile(Directory("one") + "/suite.yaml"),
            ReadWholeFile(Directory("two") + "/suite.yaml"));
}

TEST_F(Run, GivesTheSameBytesAfterBeingKilledAgainAndAgain) {
  ASSERT_EQ(RunWarmjoint(Command("whole")).status, 0);

  // each start is killed a little later, so that some realizations are in and others are not
  for (const double delay : {0.03, 0.08, 0.15, 0.3}) {
    RunAndSignal(Command("killed", {"--jobs", "1"}), SIGKILL, delay);
  }
  ASSERT_EQ(RunWarmjoint(Command("killed")).status, 0);
  EXPECT_EQ(Results("killed"), Results("whole"));
}

TEST_F(Run, IsInterruptedWithStatus130AndGoesOn) {
  ASSERT_EQ(RunWarmjoint(Command("whole", {"--realizations", "2000"})).status, 0);
  EXPECT_EQ(RunAndSignal(Command("stopped", {"--realizations", "2000"}), SIGINT, 0.4), 130);
  EXPECT_FALSE(std::filesystem::exists(Directory("stopped") + "/results.csv"));
  ASSERT_EQ(RunWarmjoint(Command("stopped", {"--realizations", "2000"})).status, 0);
  EXPECT_EQ(Results("stopped"), Results("whole"));
}

TEST_F(Run, AnotherRunInTheSameDirectoryIsRefusedWithWhatDiffers) {
  ASSERT_EQ(RunWarmjoint(Command("run", {"--realizations", "2"})).status, 0);
  const std::string results = Results("run");
  const auto refusal = [&](const std::vector<std::string>& more) {
    const Answer answer = RunWarmjoint(Command("run", more));
    EXPECT_EQ(answer.status, 2);
    return answer.err;
  };
  EXPECT_THAT(refusal({"--realizations", "3"}),
              HasSubstr("realizations: 2 in the directory, 3 asked"));
  EXPECT_THAT(refusal({"--realizations", "2", "--seed", "9"}),
              HasSubstr("seed: 3 in the directory, 9 asked"));
  EXPECT_THAT(refusal({"--realizations", "2", "--identifier", "em"}), HasSubstr("identifiers"));
  EXPECT_EQ(Results("run"), results);
  EXPECT_EQ(RunWarmjoint(Command("run", {"--realizations", "2"})).status, 0) << "same run";
}

TEST_F(Run, TakesTheIdentifiersThatAreNamed) {
  ASSERT_EQ(
      RunWarmjoint(Command("ls", {"--realizations", "2", "--identifier", "nominal-ls"})).status, 0);
  EXPECT_THAT(Results("ls"), Not(HasSubstr("em,")));
  const Answer unknown = RunWarmjoint(Command("none", {"--identifier", "nominal"}));
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("nominal-ls"));
  EXPECT_FALSE(std::filesystem::exists(Directory("none"))) << "left behind";
}

TEST_F(Run, ShardsMergeToTheBytesOfTheWhole) {
  ASSERT_EQ(RunWarmjoint(Command("whole")).status, 0);
  ASSERT_EQ(RunWarmjoint(Command("first", {"--shard", "1/2"})).status, 0);
  ASSERT_EQ(RunWarmjoint(Command("second", {"--shard", "2/2"})).status, 0);
  ASSERT_EQ(
      RunWarmjoint({"merge", Directory("first"), Directory("second"), "-o", Directory("merged")})
          .status,
      0);
  EXPECT_EQ(Results("merged"), Results("whole"));
  EXPECT_LT(Results("first").size(), Results("whole").size());

  const Answer twice =
      RunWarmjoint({"merge", Directory("first"), Directory("first"), "-o", Directory("twice")});
  EXPECT_EQ(twice.status, 2);
  EXPECT_THAT(twice.err, HasSubstr("holds realization 0"));
}

TEST_F(Run, ReplaysOneRealizationBitForBit) {
  ASSERT_EQ(RunWarmjoint(Command("run", {"--realizations", "4", "--keep-recordings"})).status, 0);
  ASSERT_EQ(RunWarmjoint({"simulate", "--from", Directory("run"), "--realization", "3", "-o",
                          Directory("replay")})
                .status,
            0);
  EXPECT_EQ(ReadWholeFile(Directory("replay") + "/truth.json"),
            ReadWholeFile(Directory("run") + "/recordings/variant-0/realization-3.truth.json"));
  const Answer beyond = RunWarmjoint(
      {"simulate", "--from", Directory("run"), "--realization", "4", "-o", Directory("none")});
  EXPECT_EQ(beyond.status, 2);
  EXPECT_THAT(beyond.err, HasSubstr("has 0 to 3"));
}

TEST_F(Run, IdentifiersOfOthersStandBesideOurs) {
  const std::string theirs =
      "theirs=echo '{\"status\": \"ok\", \"parameters\": {\"viscous\": {\"value\": 5, \"unit\": "
      "\"N.m.s/rad\", \"std\": null, \"interval95\": null}}}' > {estimate} < {recording}";
  const std::string broken = "broken=false {recording} {estimate}";
  ASSERT_EQ(RunWarmjoint(Command("run", {"--realizations", "3", "--identifier", theirs,
                                         "--identifier", broken, "--identifier", "nominal-ls"}))
                .status,
            0);
  const auto board =
      nlohmann::json::parse(RunWarmjoint({"compare", Directory("run"), "--format", "json"}).out);
  for (const auto& row : board.at("rows")) {
    if (row.at("identifier") == "broken") {
      EXPECT_EQ(row.at("failures").at("crashed"), 3);
    } else if (row.at("identifier") == "nominal-ls") {
      // the joint warms up; how far off its values are is told all the same
      EXPECT_EQ(row.at("failures").at("inadequate_model"), 3);
      EXPECT_GT(row.at("npe").at("continuous").at("median").get<double>(), 0.5);
    } else {
      EXPECT_TRUE(row.at("failures").empty());
    }
  }
}

TEST_F(Run, IsDoneWhenAllResultsAreVerdictsButNotWithoutAnyAnswer) {
  const Answer verdicts =
      RunWarmjoint(Command("run", {"--realizations", "2", "--identifier", "nominal-ls"}));
  EXPECT_EQ(verdicts.status, 0) << verdicts.err;
  EXPECT_THAT(verdicts.out, HasSubstr("2 results, 2 of them failures"));
  const Answer silence = RunWarmjoint(Command(
      "silent", {"--realizations", "2", "--identifier", "broken=false {recording} {estimate}"}));
  EXPECT_EQ(silence.status, 3);
  EXPECT_THAT(silence.err, HasSubstr("no identifier answered"));
}

TEST_F(Run, ComparesInEveryFormat) {
  ASSERT_EQ(RunWarmjoint(Command("run", {"--realizations", "5"})).status, 0);
  const auto board =
      nlohmann::json::parse(RunWarmjoint({"compare", Directory("run"), "--format", "json"}).out);
  EXPECT_EQ(board.at("suite"), "little");
  EXPECT_EQ(board.at("realizations"), 5);
  ASSERT_EQ(board.at("rows").size(), 2u);
  for (const auto& row : board.at("rows")) EXPECT_EQ(row.at("runs"), 5);
  EXPECT_THAT(RunWarmjoint({"compare", Directory("run")}).out, HasSubstr("em: claimed RMSE 0.5"));
  EXPECT_THAT(RunWarmjoint({"compare", Directory("run"), "--format", "markdown"}).out,
              HasSubstr("| nominal-ls |"));
  EXPECT_THAT(RunWarmjoint({"compare", Directory("run"), "--format", "csv"}).out,
              HasSubstr("\nnominal-ls,5,"));
}

TEST_F(Run, BadSuitesLeaveNothingBehind) {
  std::string text = SuiteText();
  text.replace(text.find("name: nominal-ls"), 16, "name: nominal-sl");
  WriteWholeFile(suite_, text);
  const Answer answer = RunWarmjoint(Command("run"));
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, HasSubstr("did you mean 'nominal-ls'?"));
  EXPECT_FALSE(std::filesystem::exists(Directory("run")));
}

}  // namespace
}  // namespace warmjoint
