// What is said to Slurm and what becomes of its answers, with a Slurm that is three scripts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/cli/table_one_yaml.h"
#include "tests/tools/scratch_directory.h"

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
  EXPECT_EQ(nlohmann::json::parse(rest.out)["shards"]["waiting"].size(), 20u);
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
