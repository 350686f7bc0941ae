#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/identify.h>
#include <warmjoint/score.h>
#include <warmjoint/suite.h>

#include <cmath>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/cli/table_one_yaml.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint::api {
namespace {

using testing::HasSubstr;

const char* const kIdentifiers = "  - {name: nominal-ls}\n  - {name: energy-ml}\n";

/// A suite file of so many realizations.
std::string SuiteFile(const ScratchDirectory& scratch, int realizations) {
  const std::string file = scratch.path() / "little.yaml";
  WriteWholeFile(file, TableOneSuite(realizations, kIdentifiers));
  return file;
}

TEST(Suite, HasTheLeaderboardOfTheCommand) {
  const ScratchDirectory scratch;
  const std::string suite = SuiteFile(scratch, 6), theirs = scratch.path() / "theirs";
  ASSERT_EQ(RunWarmjoint({"run", suite, "-o", theirs, "--realizations", "3"}).status, 0);
  for (const std::string format : {"text", "markdown", "json", "csv"}) {
    EXPECT_EQ(FormatLeaderboard(theirs, format),
              RunWarmjoint({"compare", theirs, "--format", format}).out);
  }

  // run here, in quiet
  RunSettings settings;
  settings.realizations = 3;
  settings.jobs = 1;
  int told = 0;
  settings.watch = [&](int finished, int total) {
    EXPECT_GT(finished, told);
    EXPECT_EQ(total, 3);
    told = finished;
  };
  testing::internal::CaptureStderr();
  const RunSummary summary = RunSuite(suite, scratch.path() / "ours", settings);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(told, 3);
  EXPECT_EQ(summary.realizations, 3);
  EXPECT_EQ(summary.results, 6u);
  EXPECT_TRUE(summary.silent.empty());

  const Leaderboard ours = ReadLeaderboard(scratch.path() / "ours"),
                    board = ReadLeaderboard(theirs);
  EXPECT_EQ(ours.suite, "little");
  EXPECT_EQ(ours.realizations, 3);
  ASSERT_EQ(ours.rows.size(), board.rows.size());
  for (std::size_t i = 0; i < ours.rows.size(); ++i) {
    EXPECT_EQ(ours.rows[i].identifier, board.rows[i].identifier);
    EXPECT_EQ(ours.rows[i].failures, board.rows[i].failures);
    // the program masks glibc's forms with fused multiply-adds, this process does not: an iterative
    // fit then differs by what it leaves open
    EXPECT_NEAR(ours.rows[i].npe_continuous.median, board.rows[i].npe_continuous.median, 1e-6);
    EXPECT_NEAR(ours.rows[i].rmse.median, board.rows[i].rmse.median, 1e-6);
  }
}

TEST(Suite, TellsOfJointsThatDoNotFollowTheirMotion) {
  const ScratchDirectory scratch;
  const std::string suite = scratch.path() / "slow.yaml";
  std::string text = TableOneSuite(1, "  - {name: nominal-ls}\n");
  const std::string engine =
      "  plant: mujoco\n  robot: rotary\n  joint: hinge\n  timestep: 0.002\n"
      "  controller: {bandwidth: 1}\n";
  const std::string ideal = "  plant: ideal\n";
  WriteWholeFile(suite, text.replace(text.find(ideal), ideal.size(), engine));
  EXPECT_THAT(RunSuite(suite, scratch.path() / "run").not_following,
              testing::HasSubstr("in 1 of 1 simulated realizations"));
}

TEST(Suite, StopsWhereTheWatchThrowsAndGoesOn) {
  const ScratchDirectory scratch;
  const std::string suite = SuiteFile(scratch, 4);
  RunSettings settings;
  settings.jobs = 1;
  settings.identifiers = {"nominal-ls"};
  settings.watch = [](int, int) { throw std::runtime_error("enough"); };
  EXPECT_THROW(RunSuite(suite, scratch.path() / "run", settings), std::runtime_error);
  settings.watch = {};
  EXPECT_EQ(RunSuite(suite, scratch.path() / "run", settings).results, 4u);
}

TEST(Suite, RefusesWhatTheCommandRefuses) {
  const ScratchDirectory scratch;
  const std::string suite = SuiteFile(scratch, 1);
  const auto refusal = [&](auto change) {
    RunSettings settings;
    change(settings);
    try {
      RunSuite(suite, scratch.path() / "run", settings);
    } catch (const BadInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal([](RunSettings& s) { s.jobs = 0; }), HasSubstr("from 1 to 1024"));
  EXPECT_THAT(refusal([](RunSettings& s) { s.realizations = -1; }), HasSubstr("--realizations"));
  EXPECT_THAT(refusal([](RunSettings& s) { s.identifiers = {"nominal"}; }),
              HasSubstr("nominal-ls"));
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "run"));
  EXPECT_THROW(ReadLeaderboard(scratch.path() / "run"), BadInput);
  EXPECT_THROW(FormatLeaderboard(scratch.path() / "run", "xls"), BadInput);
  WriteWholeFile(suite, TableOneSuite(1,
                                      "  - {name: external, label: mine, options: "
                                      "{command: 'true {recording} {estimate}'}}\n"));
  EXPECT_THAT(refusal([](RunSettings&) {}), HasSubstr("--allow-commands")) << "nobody agreed";
}

TEST(Score, IsThatOfTheLeaderboard) {
  const ScratchDirectory scratch;
  const std::string suite = SuiteFile(scratch, 1);
  RunSettings run;
  run.identifiers = {"nominal-ls", "energy-ml"};
  RunSuite(suite, scratch.path() / "run", run);
  const Leaderboard board = ReadLeaderboard(scratch.path() / "run");

  SimulateSettings settings;
  settings.seed = 3;  // of the suite
  const Simulation simulation = SimulateText(TableOneYaml(1800), settings);
  const PreparedLog log(simulation.recording);
  for (const LeaderboardRow& row : board.rows) {
    IdentifySettings identify;
    identify.identifier = row.identifier;
    const Score score = ScoreEstimate(Identify(log, identify), log, simulation.truth);
    EXPECT_DOUBLE_EQ(score.npe_continuous, row.npe_continuous.median) << row.identifier;
    EXPECT_DOUBLE_EQ(score.npe_discrete, row.npe_discrete.median);
    EXPECT_DOUBLE_EQ(score.bound_npe_continuous, board.bound_npe_continuous);
    EXPECT_DOUBLE_EQ(score.metrics->rmse, row.rmse.median);
    EXPECT_DOUBLE_EQ(score.metrics->mae, row.mae.median);
    EXPECT_DOUBLE_EQ(score.metrics->fit, row.fit.median);
    EXPECT_DOUBLE_EQ(score.metrics->fpe, row.fpe.median);
  }
}

}  // namespace
}  // namespace warmjoint::api
