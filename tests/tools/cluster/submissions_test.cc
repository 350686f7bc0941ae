// What is said to Slurm and what becomes of its answers, with a Slurm that is three scripts.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/cli/table_one_yaml.h"
#include "tests/tools/scratch_directory.h"
#include "tools/cluster/plan.h"
#include "tools/cluster/run_layout.h"
#include "tools/cluster/shard_state.h"

namespace warmjoint {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Submissions : public testing::Test {
 protected:
  void SetUp() override {
    WriteWholeFile(suite_, TableOneSuite(25, "  - {name: nominal-ls}\n"));
    std::filesystem::create_directory(scratch_.path() / "bin");
    Script("scontrol", "echo 'MaxArraySize            = 10'");
    Script("scancel", "echo \"scancel $*\" >>" + Path("said"));
    Queue("");
    // the jobs are 101, 102, ...; call number REFUSED is refused
    Script("sbatch", "echo \"$*\" >>" + Path("said") + "\nn=$(grep -c . " + Path("said") + ")\n" +
                         "[ $n != \"$(cat " + Path("refused") +
                         ")\" ] || { echo 'sbatch: error: "
                         "Invalid partition' >&2; exit 1; }\necho $((100 + n))");
    Refuse(0);
    path_ = getenv("PATH");
    setenv("PATH", (Path("bin") + ":" + path_).c_str(), 1);
  }
  void TearDown() override { setenv("PATH", path_.c_str(), 1); }

  std::string Path(const std::string& name) const { return scratch_.path() / name; }
  void Script(const std::string& name, const std::string& body) const {
    const std::string file = Path("bin") + "/" + name;
    WriteWholeFile(file, "#!/bin/sh\n" + body + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }
  void Queue(const std::string& lines) const { Script("squeue", "printf '" + lines + "'"); }
  void Refuse(int call) const { WriteWholeFile(Path("refused"), std::to_string(call) + "\n"); }
  std::string Said() const { return ReadWholeFile(Path("said")); }
  ProgramAnswer Run(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command{"run", suite_, "-o", Path("run"), "--slurm", "--shards", "25"};
    command.insert(command.end(), more.begin(), more.end());
    return RunWarmjoint(command);
  }

  ScratchDirectory scratch_;
  std::string suite_ = scratch_.path() / "little.yaml";
  std::string path_;
};

TEST_F(Submissions, AreArraysOfTheClustersSizeAndAMergeAfterThem) {
  const ProgramAnswer answer = Run({"--array-parallelism", "6", "--sbatch", "partition=long"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("jobs 104, 101, 102, 103"));
  const std::string script = Path("run") + "/slurm/array.sbatch";
  EXPECT_THAT(Said(), AllOf(HasSubstr("--array=0-9%2 " + script + " 0\n"),
                            HasSubstr("--array=0-9%2 " + script + " 10\n"),
                            HasSubstr("--array=0-4%2 " + script + " 20\n"),
                            HasSubstr("--dependency=afterany:101:102:103 ")));

  // nothing twice
  const ProgramAnswer again = Run();
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, HasSubstr("submitted already"));

  RunWarmjoint({"cancel", Path("run")});
  EXPECT_THAT(Said(), HasSubstr("scancel -Q 104 101 102 103"));
}

TEST_F(Submissions, ARefusalNamesTheRangeAndWhatIsSubmitted) {
  Refuse(3);
  const ProgramAnswer refused = Run();
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("shards 21 to 25 could not be submitted"),
                                 HasSubstr("Invalid partition"),
                                 HasSubstr("submitted are 1-10 as job 101, 11-20 as job 102")));

  // the rest, and it alone
  std::string queue;
  for (const char* job : {"101", "102"}) {
    for (int i = 0; i < 10; ++i) queue += job + (" " + std::to_string(i)) + " PENDING\\n";
  }
  Queue(queue);
  WriteWholeFile(Path("said"), "x\nx\nx\nx\n");
  const ProgramAnswer rest =
      RunWarmjoint({"status", Path("run"), "--resubmit", "--format", "json"});
  ASSERT_EQ(rest.status, 0) << rest.err;
  EXPECT_THAT(rest.err, HasSubstr("shards 21-25"));
  EXPECT_THAT(Said(), AllOf(HasSubstr("--array=0-4 "), Not(HasSubstr("--array=0-9"))));
  // merged behind the arrays of the first call, too
  EXPECT_THAT(Said(), HasSubstr("--dependency=afterany:101:102:105 "));
  EXPECT_EQ(nlohmann::json::parse(rest.out)["shards"]["waiting"].size(), 20u);
}

TEST_F(Submissions, OfShardsThatAreAllDoneAreTheMergeAlone) {
  ASSERT_EQ(Run({"--dry-run"}).status, 0);
  for (int shard = 1; shard <= 25; ++shard) {
    ASSERT_EQ(RunWarmjoint({"task", Path("run"), std::to_string(shard)}).status, 0);
  }
  const ProgramAnswer answer = Run();
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_EQ(Said(), "--parsable " + Path("run") + "/slurm/merge.sbatch\n");
}

TEST_F(Submissions, AreOfFailedShardsToo) {
  ASSERT_EQ(Run({"--dry-run"}).status, 0);
  const std::filesystem::path folder = ShardFolder(Path("run"), 3);
  std::filesystem::create_directories(folder);
  ShardState state;
  state.phase = Phase::failed;
  WriteShardState(folder, state);
  ASSERT_EQ(Run().status, 0);
  EXPECT_THAT(Said(), HasSubstr("--array=0-9 "));
  EXPECT_EQ(ReadShardState(folder)->phase, Phase::interrupted);
}

TEST_F(Submissions, GoByThePlanThatIsThere) {
  ASSERT_EQ(Run({"--dry-run"}).status, 0);
  const ProgramAnswer same = Run({"--dry-run"});
  EXPECT_EQ(same.err, "");
  const ProgramAnswer other = Run({"--dry-run", "--jobs", "3", "--sbatch", "partition=long"});
  EXPECT_EQ(other.status, 0);
  EXPECT_THAT(other.err, AllOf(HasSubstr("--jobs 3"), HasSubstr("--sbatch partition=long"),
                               Not(HasSubstr("--shards"))));
}

TEST_F(Submissions, OfPiecesKeepEveryRealizationWhereTheyAreRefused) {
  ASSERT_EQ(Run({"--dry-run"}).status, 0);
  // the one shard has lost its task after five failures, of which two lie behind the first hole
  Plan plan = ReadPlan(Path("run"));
  plan.shards = {{0, 25}};
  WritePlan(Path("run"), plan);
  ASSERT_EQ(RunWarmjoint({"task", Path("run"), "1"}).status, 0);
  const std::filesystem::path folder = ShardFolder(Path("run"), 1);
  SQLite::Database results((folder / "results.sqlite").string(), SQLite::OPEN_READWRITE);
  for (const std::string table : {"realization", "result", "parameter", "trace"}) {
    results.exec("DELETE FROM " + table + " WHERE realization = 10");
  }
  results.exec("UPDATE result SET status = 'no_answer' WHERE realization IN (2, 5, 7, 12, 20)");
  ShardState state = *ReadShardState(folder);
  state.phase = Phase::interrupted;
  state.failures = {{"no_answer", 5}};
  WriteShardState(folder, state);

  // sbatch refuses: what is done and what is open make up the whole all the same
  WriteWholeFile(Path("said"), "");
  Refuse(1);
  const ProgramAnswer answer = RunWarmjoint({"status", Path("run"), "--resubmit", "--split", "2"});
  EXPECT_THAT(answer.err, HasSubstr("could not be submitted"));
  const Plan split = ReadPlan(Path("run"));
  ASSERT_EQ(split.shards.size(), 3u);
  EXPECT_EQ(split.shards[0].end, 10);
  EXPECT_EQ(split.shards[1].first, 10);
  EXPECT_EQ(split.shards[2].end, 25);
  EXPECT_EQ(ReadShardState(folder)->phase, Phase::done);
  EXPECT_EQ(ReadShardState(folder)->failures.at("no_answer"), 3);
}

TEST_F(Submissions, OfPiecesLeaveAllAsItIsWhereOneShardCannotBeRead) {
  ASSERT_EQ(Run({"--dry-run"}).status, 0);
  const std::filesystem::path damaged = ShardFolder(Path("run"), 2);
  std::filesystem::create_directories(damaged);
  WriteWholeFile(damaged / "results.sqlite", "no database");
  EXPECT_EQ(RunWarmjoint({"status", Path("run"), "--resubmit", "--split", "2"}).status, 2);
  EXPECT_FALSE(ReadShardState(ShardFolder(Path("run"), 1)));
  EXPECT_EQ(ReadPlan(Path("run")).shards.size(), 25u);
}

TEST_F(Submissions, WithoutAnAnswerOfTheQueueNothingIsTakenForLost) {
  ASSERT_EQ(Run().status, 0);
  Script("squeue", "exit 1");
  const ProgramAnswer answer = RunWarmjoint({"status", Path("run"), "--resubmit"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, HasSubstr("Slurm does not answer"));
  EXPECT_THAT(RunWarmjoint({"status", Path("run")}).out, HasSubstr("25 missing"));
}

}  // namespace
}  // namespace warmjoint
