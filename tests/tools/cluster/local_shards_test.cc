// A run in shards on this machine: the bytes of the run in one piece, whatever is killed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>

#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/cli/table_one_yaml.h"
#include "tests/tools/scratch_directory.h"
#include "tools/cluster/plan.h"
#include "tools/cluster/run_layout.h"
#include "tools/cluster/shard_state.h"
#include "tools/cluster/task_folder.h"

namespace warmjoint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class LocalShards : public testing::Test {
 protected:
  void SetUp() override {
    WriteWholeFile(suite_, TableOneSuite(40,
                                         "  - {name: nominal-ls}\n"
                                         "  - {name: energy-als, options: {iterations: 20}}\n"));
    // what tasks keep on the machine's own disk
    std::filesystem::create_directory(scratch_.path() / "tmp");
    setenv("TMPDIR", (scratch_.path() / "tmp").c_str(), 1);
  }
  void TearDown() override { unsetenv("TMPDIR"); }

  std::string Path(const std::string& name) const { return scratch_.path() / name; }

  std::vector<std::string> Command(const std::string& name,
                                   const std::vector<std::string>& more) const {
    std::vector<std::string> command{"run", suite_, "-o", Path(name)};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }

  nlohmann::json Status(const std::string& name) const {
    return nlohmann::json::parse(RunWarmjoint({"status", Path(name), "--format", "json"}).out);
  }

  /// Expects every file of a run, timings apart, to be that of the run in one piece.
  void ExpectWhole(const std::string& name) const {
    ASSERT_EQ(RunWarmjoint(Command("whole", {})).status, 0);
    for (const char* file : {"/results.csv", "/summary.csv", "/suite.yaml"}) {
      EXPECT_EQ(ReadWholeFile(Path(name) + file), ReadWholeFile(Path("whole") + file)) << file;
    }
  }

  /// Changes a text in the plan.
  void Edit(const std::string& name, const std::string& from, const std::string& to) const {
    const std::string file = Path(name) + "/slurm/plan.json";
    std::string text = ReadWholeFile(file);
    ASSERT_NE(text.find(from), std::string::npos);
    WriteWholeFile(file, text.replace(text.find(from), from.size(), to));
  }

  ScratchDirectory scratch_;
  std::string suite_ = scratch_.path() / "little.yaml";
};

TEST_F(LocalShards, GiveTheBytesOfTheWholeWithEmptyOnesToo) {
  const ProgramAnswer answer =
      RunWarmjoint(Command("run", {"--local-shards", "2", "--shards", "45"}));
  ASSERT_EQ(answer.status, 0) << answer.err;
  ExpectWhole("run");
  EXPECT_EQ(Status("run")["shards"]["done"].size(), 45u);
  EXPECT_TRUE(Status("run")["merged"]);
  EXPECT_TRUE(std::filesystem::is_empty(scratch_.path() / "tmp" / "warmjoint-0") ||
              !std::filesystem::exists(scratch_.path() / "tmp" / "warmjoint-0"))
      << "left behind";
}

TEST_F(LocalShards, ADryRunStopsAtThePlanWhichWorksByHand) {
  const ProgramAnswer plan =
      RunWarmjoint(Command("run", {"--local-shards", "1", "--shards", "4", "--dry-run"}));
  ASSERT_EQ(plan.status, 0) << plan.err;
  EXPECT_THAT(plan.out, HasSubstr("parallel"));
  EXPECT_FALSE(std::filesystem::exists(Path("run") + "/shards"));
  EXPECT_THAT(Status("run")["shards"]["missing"], ElementsAre(1, 2, 3, 4));

  // partial results are there to be read
  ASSERT_EQ(RunWarmjoint({"task", Path("run"), "2"}).status, 0);
  ASSERT_EQ(RunWarmjoint({"task", Path("run"), "4"}).status, 0);
  EXPECT_THAT(RunWarmjoint({"compare", Path("run")}).out, HasSubstr("20 of 40 realizations"));
  EXPECT_THAT(Status("run")["shards"]["missing"], ElementsAre(1, 3));
  EXPECT_EQ(Status("run")["realizations"]["finished"], 20);

  // what is missing is said, and nothing half-made is left
  const ProgramAnswer merge = RunWarmjoint({"merge", Path("run")});
  EXPECT_EQ(merge.status, 2);
  EXPECT_THAT(merge.err, HasSubstr("20 of 40 realizations; shards 1, 3"));
  EXPECT_FALSE(std::filesystem::exists(Path("run") + "/results.sqlite"));

  for (const char* number : {"1", "3", "3"}) {
    ASSERT_EQ(RunWarmjoint({"task", Path("run"), number}).status, 0);
  }
  ASSERT_EQ(RunWarmjoint({"merge", Path("run")}).status, 0);
  ExpectWhole("run");
}

TEST_F(LocalShards, AKilledTaskGoesOnFromItsOwnStore) {
  ASSERT_EQ(
      RunWarmjoint(Command("run", {"--local-shards", "1", "--shards", "1", "--dry-run"})).status,
      0);
  int killed = 0;
  for (const double delay : {0.25, 0.35, 0.45, 0.6}) {
    killed += RunAndSignal({"task", Path("run"), "1"}, SIGKILL, delay) == 128 + SIGKILL;
  }
  EXPECT_GE(killed, 1);
  // one that is asked to end keeps what is finished, however slow the machine is
  int finished = 0;
  for (double delay = 0.5; finished == 0; delay *= 1.3) {
    RunAndSignal({"task", Path("run"), "1"}, SIGTERM, delay);
    finished = Status("run")["realizations"]["finished"];
  }
  ASSERT_EQ(RunWarmjoint(Command("run", {"--local-shards", "1"})).status, 0);
  ExpectWhole("run");
}

TEST_F(LocalShards, AShardThatNeverGetsOnHasFailedWithItsLastWords) {
  ASSERT_EQ(
      RunWarmjoint(Command("run", {"--local-shards", "1", "--shards", "2", "--dry-run"})).status,
      0);
  Edit("run", "law: viscous_coulomb", "law: viscous_coulumb");
  const ProgramAnswer task = RunWarmjoint({"task", Path("run"), "1"});
  EXPECT_NE(task.status, 0);
  EXPECT_THAT(task.err, HasSubstr("viscous_coulumb"));
}

TEST_F(LocalShards, AMachineThatCalculatesOtherwiseRefuses) {
  ASSERT_EQ(
      RunWarmjoint(Command("run", {"--local-shards", "1", "--shards", "2", "--dry-run"})).status,
      0);
  Edit("run", "\"mujoco\": \"", "\"mujoco\": \"f");
  const ProgramAnswer task = RunWarmjoint({"task", Path("run"), "1"});
  EXPECT_EQ(task.status, 2);
  EXPECT_THAT(task.err, HasSubstr("made where mujoco is f"));
  EXPECT_THAT(Status("run")["last_words"].dump(), HasSubstr("made where mujoco is f"));
  EXPECT_THAT(Status("run")["shards"]["done"], IsEmpty());
}

TEST_F(LocalShards, AnInterruptedTaskLeavesAShardToTheOneAtWork) {
  ASSERT_EQ(
      RunWarmjoint(Command("run", {"--local-shards", "1", "--shards", "2", "--dry-run"})).status,
      0);
  const std::filesystem::path folder = ShardFolder(Path("run"), 1);
  std::filesystem::create_directories(folder);
  ShardState state;
  state.owner = "elsewhere:12";
  state.updated = Now();
  WriteShardState(folder, state);
  const std::string before = ReadWholeFile(folder / "state.json");
  EXPECT_EQ(RunAndSignal({"task", Path("run"), "1"}, SIGTERM, 1), 130);
  EXPECT_EQ(ReadWholeFile(folder / "state.json"), before);
}

TEST_F(LocalShards, ADamagedStoreOfTheMachineGivesWayToTheRunsCopy) {
  ASSERT_EQ(
      RunWarmjoint(Command("run", {"--local-shards", "1", "--shards", "1", "--dry-run"})).status,
      0);
  // what a killed task left: a store that is no database any more
  const TaskFolder left(ReadPlan(Path("run")), 1);
  std::filesystem::create_directories(left.store());
  for (const char* name : {"suite.yaml", "results.sqlite"}) {
    WriteWholeFile(left.store() / name, std::string(8192, 'x'));
  }
  const ProgramAnswer task = RunWarmjoint({"task", Path("run"), "1"});
  ASSERT_EQ(task.status, 0) << task.err;
  ASSERT_EQ(RunWarmjoint(Command("run", {"--local-shards", "1"})).status, 0);
  ExpectWhole("run");
}

TEST_F(LocalShards, APlanIsThereOnceItsScriptsAre) {
  // scripts that cannot be written
  std::filesystem::create_directories(Path("run") + "/slurm/array.sbatch/in-the-way");
  const std::vector<std::string> command =
      Command("run", {"--local-shards", "1", "--shards", "2", "--dry-run"});
  EXPECT_NE(RunWarmjoint(command).status, 0);
  std::filesystem::remove_all(Path("run") + "/slurm/array.sbatch");
  ASSERT_EQ(RunWarmjoint(command).status, 0);
  EXPECT_TRUE(std::filesystem::exists(Path("run") + "/slurm/merge.sbatch"));
}

TEST_F(LocalShards, ASecondCommandForTheSameRunIsRefused) {
  ASSERT_EQ(
      RunWarmjoint(Command("run", {"--local-shards", "1", "--shards", "2", "--dry-run"})).status,
      0);
  const ProgramAnswer other = RunWarmjoint(Command("run", {"--local-shards", "1", "--seed", "4"}));
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("seed: 3 in the directory, 4 asked"));
}

}  // namespace
}  // namespace warmjoint
