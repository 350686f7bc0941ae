#include "tools/cluster/make_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/scratch_directory.h"
#include "tools/cluster/batch_script.h"
#include "tools/cluster/run_layout.h"

namespace warmjoint {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(MakePlan, BlocksFollowOneAnotherWithoutGaps) {
  for (const int count : {1, 7, 40, 55}) {
    const std::vector<PlannedShard> shards = PartEvenly(3, 43, count);
    ASSERT_EQ(shards.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(shards.front().first, 3);
    EXPECT_EQ(shards.back().end, 43);
    for (std::size_t i = 1; i < shards.size(); ++i) {
      EXPECT_EQ(shards[i].first, shards[i - 1].end);
      EXPECT_LE(std::abs(shards[i].size() - shards[0].size()), 1);
    }
  }
}

TEST(MakePlan, AShardTakes5To30Minutes) {
  for (const double seconds : {0.001, 0.05, 3.0, 250.0}) {
    for (const int realizations : {2000, 1'000'000}) {
      const int count = ShardCount(realizations, seconds, 2);
      const double length = realizations * seconds / 2 / count;
      if (count == 1) {
        EXPECT_LE(length, 1800);
      } else {
        EXPECT_GE(length, 300);
        EXPECT_LE(length, 1800);
      }
    }
  }
  EXPECT_EQ(ShardCount(3, 1e5, 1), 3) << "a realization is not parted";
}

Plan Little() {
  Plan plan;
  plan.id = "0123456789abcdef";
  plan.suite_yaml = "name: little\n";
  plan.directory = "/somewhere";
  plan.versions = {{"warmjoint", "0.1.0"}};
  plan.program = {"/opt/warm joint", "ab"};
  plan.consent = Consent::commands;
  plan.sbatch = {"partition=long"};
  plan.array_parallelism = 2;
  plan.shards = {{0, 3}, {3, 3}, {3, 7}};
  return plan;
}

TEST(Plan, ReadsBackWhatWasWritten) {
  const ScratchDirectory scratch;
  std::filesystem::create_directories(PlanFolder(scratch.path()));
  WritePlan(scratch.path(), Little());
  const Plan plan = ReadPlan(scratch.path());
  EXPECT_EQ(plan.suite_yaml, Little().suite_yaml);
  EXPECT_EQ(plan.consent, Consent::commands);
  EXPECT_EQ(plan.program.path, "/opt/warm joint");
  EXPECT_EQ(plan.versions, Little().versions);
  ASSERT_EQ(plan.shards.size(), 3u);
  EXPECT_EQ(plan.shards[1].size(), 0);
  EXPECT_EQ(plan.shards[2].end, 7);
}

TEST(Plan, RefusesWhatAnEditBroke) {
  const ScratchDirectory scratch;
  EXPECT_THAT([&] { ReadPlan(scratch.path()); }, ThrowsMessage<BadInput>(HasSubstr("no plan")));
  std::filesystem::create_directories(PlanFolder(scratch.path()));
  WritePlan(scratch.path(), Little());
  const std::string good = ReadWholeFile(PlanFile(scratch.path()));
  const auto edited = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    WriteWholeFile(PlanFile(scratch.path()), text);
    ReadPlan(scratch.path());
  };
  EXPECT_THAT([&] { edited("\"jobs\"", "\"job\""); }, ThrowsMessage<BadInput>(HasSubstr("jobs")));
  EXPECT_THAT([&] { edited("\"jobs\": 1", "\"jobs\": -1"); },
              ThrowsMessage<BadInput>(HasSubstr("from 1 to 1024")));
  EXPECT_THAT([&] { edited("   7", "   2"); }, ThrowsMessage<BadInput>(HasSubstr("[3,2]")));
  EXPECT_THAT([&] { edited("\"partition=long\"", "7"); },
              ThrowsMessage<BadInput>(AllOf(HasSubstr("'sbatch' holds 7"), HasSubstr("texts"))));
  EXPECT_THAT([&] { edited("\"0.1.0\"", "0.1"); },
              ThrowsMessage<BadInput>(HasSubstr("'warmjoint' of 'versions' is 0.1")));
  EXPECT_THAT([&] { edited("\"commands\"", "\"comands\""); },
              ThrowsMessage<BadInput>(
                  AllOf(HasSubstr("'consent' is \"comands\""), HasSubstr("\"commands\""))));
}

TEST(Plan, HoldsConsentAsAWord) {
  const ScratchDirectory scratch;
  std::filesystem::create_directories(PlanFolder(scratch.path()));
  WritePlan(scratch.path(), Little());
  const std::string text = ReadWholeFile(PlanFile(scratch.path()));
  EXPECT_THAT(text, HasSubstr("\"consent\": \"commands\""));
}

TEST(BatchScript, HandsKeysOnAndKeepsItsOwn) {
  const std::string script = ArrayScript(Little(), "/run it", 2);
  EXPECT_THAT(script, HasSubstr("#SBATCH --partition=long\n"));
  EXPECT_THAT(script, HasSubstr("#SBATCH --array=0-1%1\n"));
  EXPECT_THAT(script, HasSubstr("#SBATCH --requeue\n"));
  EXPECT_THAT(script, HasSubstr("#SBATCH --signal=B:TERM@60\n"));
  EXPECT_THAT(script, HasSubstr("'/opt/warm joint' task '/run it' "));
  EXPECT_THAT(script, HasSubstr("sbatch --array=0%1 '/run it/slurm/array.sbatch' 2\n"));
  EXPECT_NO_THROW(CheckSbatch({"time=1-00:00:00", "mem-per-cpu=2G"}));
  for (const char* entry :
       {"array=1", "partition", "=x", "time=1\nrm", "signal=KILL", "-p=x y\""}) {
    EXPECT_THROW(CheckSbatch({entry}), BadInput) << entry;
  }
}

/// A script of its own in a folder, which can be run.
std::filesystem::path Executable(const std::filesystem::path& file, const std::string& body) {
  WriteWholeFile(file, "#!/bin/sh\n" + body + "\n");
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  return file;
}

TEST(BatchScript, StartsNoTaskThatIsAskedToEndBeforeItIsThere) {
  const ScratchDirectory scratch;
  Executable(scratch.path() / "squeue", "echo COMPLETING");
  // the script is asked to end and its task is killed; a second start would end well
  Plan plan = Little();
  plan.program.path =
      Executable(scratch.path() / "program",
                 "echo start >>" + (scratch.path() / "starts").string() + "\n[ $(grep -c . " +
                     (scratch.path() / "starts").string() +
                     ") = 1 ] || exit 0\nkill -TERM $PPID; sleep 0.2; kill -KILL $$");
  const std::filesystem::path script =
      Executable(scratch.path() / "array.sbatch", ArrayScript(plan, "/run", 1000));
  const ProgramAnswer answer =
      RunCommandLine({"bash", script}, {{},
                                        {{"PATH", scratch.path().string() + ":" + getenv("PATH")},
                                         {"SLURM_ARRAY_JOB_ID", "1"},
                                         {"SLURM_ARRAY_TASK_ID", "0"}}});
  EXPECT_EQ(answer.status, 130) << answer.err;
  EXPECT_EQ(ReadWholeFile(scratch.path() / "starts"), "start\n");
}

}  // namespace
}  // namespace warmjoint
