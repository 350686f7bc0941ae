// A run in shards, as processes of this machine and as tasks of a Slurm that is three scripts: the results of the run in
// one piece, whatever is killed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>

#include "models/foundation/bad_input.h"
#include "tests/tools/cli/in_a_folder.h"
#include "tests/tools/cli/little_files.h"
#include "tools/cluster/plan.h"
#include "tools/cluster/slurm.h"

namespace warmjoint {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class PlannedRun : public WithASuite {
 protected:
  void SetUp() override {
    WriteWholeFile(suite_, TableOneSuite(40,
                                         "  - {name: nominal-ls}\n"
                                         "  - {name: energy-als, options: {iterations: 20}}\n"));
    // what shards keep on the machine's own disk
    std::filesystem::create_directory(at("tmp"));
    setenv("TMPDIR", at("tmp").c_str(), 1);
  }
  void TearDown() override { unsetenv("TMPDIR"); }

  ProgramAnswer Run(const std::string& name, const std::vector<std::string>& more) const {
    return RunWarmjoint(Command(name, more));
  }

  nlohmann::json Shards(const std::string& name) const {
    return Json({"status", at(name)}).at("shards");
  }

  /// Expects the tables of a run to be those of the run in one piece, and nothing to be left in TMPDIR.
  void ExpectWhole(const std::string& name, const std::vector<std::string>& more = {}) const {
    ASSERT_EQ(Run("whole", more).status, 0);
    for (const char* file : {"/results.csv", "/summary.csv", "/suite.yaml"}) {
      EXPECT_EQ(File(name + file), File(std::string("whole") + file)) << file;
    }
    EXPECT_TRUE(std::filesystem::is_empty(at("tmp"))) << "left behind";
  }
};

TEST_F(PlannedRun, OnThisMachineGivesTheTablesOfTheWholeWithEmptyShardsToo) {
  const ProgramAnswer answer = Run("run", {"--local-shards", "2", "--shards", "45"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  ExpectWhole("run");
  EXPECT_EQ(Shards("run").at("done").size(), 45u);
}

TEST_F(PlannedRun, ADryRunStopsAtThePlanWhoseScriptWorksByHand) {
  ASSERT_EQ(Run("run", {"--slurm", "--shards", "4", "--dry-run"}).status, 0);
  EXPECT_THAT(Shards("run").at("missing"), ElementsAre(1, 2, 3, 4));
  const std::string script = at("run/slurm/array.sbatch");
  const auto task = [&](const char* number) {
    return RunCommandLine({"bash", script}, {{}, {{"SLURM_ARRAY_TASK_ID", number}}}).status;
  };

  // partial results are there to be read
  EXPECT_EQ(task("2"), 0);
  EXPECT_EQ(task("4"), 0);
  EXPECT_THAT(RunWarmjoint({"compare", at("run")}).out, HasSubstr("20 of 40 realizations"));
  EXPECT_THAT(Shards("run").at("missing"), ElementsAre(1, 3));

  // what is missing is said, and nothing half-made is left; without a number the script merges
  const ProgramAnswer merge = RunCommandLine({"bash", script});
  EXPECT_EQ(merge.status, 2);
  EXPECT_THAT(merge.err, HasSubstr("shards 1, 3 of 4 have no results yet"));
  EXPECT_FALSE(std::filesystem::exists(at("run/results.sqlite")));
  for (const char* number : {"1", "3", "3"}) EXPECT_EQ(task(number), 0);
  EXPECT_EQ(RunWarmjoint({"merge", at("run")}).status, 0);
  ExpectWhole("run");
}

TEST_F(PlannedRun, AShardThatIsKilledBeginsAnew) {
  const std::vector<std::string> many{"--realizations", "600"};
  const auto with = [&](const std::vector<std::string>& more) {
    return Command("run", With(more, many));
  };
  ASSERT_EQ(RunWarmjoint(with({"--local-shards", "1", "--shards", "2", "--dry-run"})).status, 0);
  // a process that has not yet taken over its signals dies of them
  EXPECT_EQ(RunAndSignal(with({"--shard", "1/2"}), SIGKILL, 0.2), 128 + SIGKILL);
  EXPECT_THAT(RunAndSignal(with({"--shard", "1/2"}), SIGTERM, 0.2), AnyOf(130, 128 + SIGTERM));
  EXPECT_THAT(RunAndSignal(with({"--local-shards", "1"}), SIGINT, 0.2), AnyOf(130, 128 + SIGINT));
  EXPECT_THAT(Shards("run").at("missing"), ElementsAre(1, 2));
  // what the killed one left on its machine is the machine's to clear
  std::filesystem::remove_all(at("tmp"));
  std::filesystem::create_directory(at("tmp"));
  ASSERT_EQ(RunWarmjoint(with({"--local-shards", "2"})).status, 0);
  ExpectWhole("run", many);
}

TEST_F(PlannedRun, RefusesAnotherSuiteAnotherPartAndAnotherNumberOfShards) {
  ASSERT_EQ(Run("run", {"--local-shards", "1", "--shards", "2", "--dry-run"}).status, 0);
  const auto refusal = [&](const std::vector<std::string>& more) {
    return Refusal(Command("run", more));
  };
  EXPECT_THAT(refusal({"--local-shards", "1", "--seed", "4"}),
              HasSubstr("seed: 3 in the directory, 4 asked"));
  EXPECT_THAT(refusal({"--local-shards", "1", "--shards", "3"}), HasSubstr("has 2 already"));
  EXPECT_THAT(refusal({"--shard", "1/3"}), HasSubstr("--shard: is 1/3"));
  EXPECT_THAT(refusal({}), HasSubstr("planned in 2 shards"));
  WriteWholeFile(at("run/slurm/plan.json"), "{\"shards\": 0}");
  EXPECT_THAT(refusal({"--local-shards", "1"}), HasSubstr("'shards' is 0"));
}

/// With a Slurm whose jobs are 101, 102, ...; it says what it was told.
class SubmittedRun : public PlannedRun {
 protected:
  void SetUp() override {
    PlannedRun::SetUp();
    std::filesystem::create_directory(at("bin"));
    Script("scontrol", "echo 'MaxArraySize            = 10'");
    Queue("");
    Script("sbatch", "[ ! -e " + at("refused") +
                         " ] || { echo 'sbatch: error: Invalid partition' >&2; exit 1; }\n" +
                         "echo \"$*\" >>" + at("said") + "\necho $((100 + $(grep -c . " +
                         at("said") + ")))");
    path_ = getenv("PATH");
    setenv("PATH", (at("bin") + ":" + path_).c_str(), 1);
  }
  void TearDown() override {
    setenv("PATH", path_.c_str(), 1);
    PlannedRun::TearDown();
  }

  void Script(const std::string& name, const std::string& body) const {
    const std::string file = at("bin/" + name);
    WriteWholeFile(file, "#!/bin/sh\n" + body + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }
  /// lines: "JOB INDEX STATE" each, of this run; another run's task stands beside them.
  void Queue(const std::string& lines) const {
    Script("squeue", "printf '" + lines + "' | sed 's#$# warmjoint:" + at("run") +
                         "#'; echo 9 1 RUNNING warmjoint:/elsewhere");
  }
  std::string Said() const { return File("said"); }

  std::string path_;
};

TEST_F(SubmittedRun, IsAnArrayAndAMergeAfterIt) {
  const ProgramAnswer answer =
      Run("run", {"--slurm", "--shards", "9", "--jobs", "2", "--sbatch", "partition=long"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  const std::string script = at("run/slurm/array.sbatch");
  EXPECT_THAT(Said(), AllOf(HasSubstr("--array=1-9 " + script + "\n"),
                            HasSubstr("--dependency=afterany:101 ")));
  EXPECT_THAT(ReadWholeFile(script), AllOf(HasSubstr("#SBATCH --partition=\"long\"\n"),
                                           HasSubstr("#SBATCH --cpus-per-task=\"2\"\n"),
                                           HasSubstr("#SBATCH --requeue\n")));

  // only what is not in the queue, and nothing twice
  Queue("101 1 RUNNING\\n101 2 COMPLETING\\n101 3 PENDING\\n102 N/A PENDING\\n");
  EXPECT_THAT(Shards("run").at("running"), ElementsAre(1, 2));
  EXPECT_THAT(Shards("run").at("waiting"), ElementsAre(3));
  const ProgramAnswer again = RunWarmjoint({"status", at("run"), "--resubmit"});
  EXPECT_THAT(again.err, HasSubstr("submitted again: shards 4-9\n"));
  EXPECT_THAT(Said(), AllOf(HasSubstr("--array=4-9 "), HasSubstr("afterany:101:103 ")));
  std::string all;
  for (const char* index : {"1", "2", "3", "4", "5", "6", "7", "8", "9"}) {
    all += std::string("101 ") + index + " PENDING\\n";
  }
  Queue(all);
  EXPECT_THAT(Run("run", {"--slurm"}).err, HasSubstr("submitted already"));
}

TEST_F(SubmittedRun, IsRefusedWithTheNumberThatFitsTheCluster) {
  EXPECT_THAT(Refusal(Command("run", {"--slurm", "--shards", "10"})), HasSubstr("give --shards 9"));
  EXPECT_FALSE(std::filesystem::exists(at("run/slurm/plan.json")));
}

TEST_F(SubmittedRun, WhatSlurmRefusesIsMissing) {
  WriteWholeFile(at("refused"), "");
  EXPECT_THAT(Refusal(Command("run", {"--slurm", "--shards", "2"})),
              AllOf(HasSubstr("Invalid partition"), HasSubstr("--resubmit")));
  std::filesystem::remove(at("refused"));
  Script("squeue", "exit 1");
  EXPECT_THAT(RunWarmjoint({"status", at("run"), "--resubmit"}).err,
              HasSubstr("Slurm does not answer"));
  Queue("");
  EXPECT_THAT(RunWarmjoint({"status", at("run"), "--resubmit"}).err,
              HasSubstr("submitted again: shards 1-2"));
}

TEST_F(SubmittedRun, AKilledShardIsRequeued) {
  ASSERT_EQ(Run("run", {"--slurm", "--shards", "2", "--dry-run"}).status, 0);
  const std::string script = at("run/slurm/array.sbatch");
  // the program is killed; the first requeue fails, and the second ends the script as Slurm does
  std::string text = ReadWholeFile(script);
  const std::size_t line = text.find(" run " + at("run/slurm/suite.yaml"));
  const std::size_t begin = text.rfind('\n', line) + 1;
  text.replace(begin, text.find('\n', line) - begin, "sh -c 'kill -KILL $$'");
  WriteWholeFile(script, text);
  Script("scontrol", "echo \"$*\" >>" + at("said") + "\n[ $(grep -c . " + at("said") +
                         ") = 1 ] && exit 1\nkill -KILL $PPID");
  const auto status = [&](const char* restarts) {
    return RunCommandLine({"bash", script}, {{},
                                             {{"SLURM_ARRAY_JOB_ID", "7"},
                                              {"SLURM_ARRAY_TASK_ID", "1"},
                                              {"SLURM_RESTART_COUNT", restarts}}})
        .status;
  };
  EXPECT_EQ(status("5"), 137);
  EXPECT_FALSE(std::filesystem::exists(at("said")));
  EXPECT_EQ(status("0"), 137);
  EXPECT_EQ(Said(), "requeue 7_1\nrequeue 7_1\n");
}

TEST(CheckSbatch, TakesKeysThatTheScriptDoesNotSet) {
  EXPECT_NO_THROW(CheckSbatch({"time=1-00:00:00", "mem-per-cpu=2G"}));
  for (const char* entry : {"array=1", "partition", "=x", "time=1\nrm", "-p=x y\""}) {
    EXPECT_THROW(CheckSbatch({entry}), BadInput) << entry;
  }
}

}  // namespace
}  // namespace warmjoint
