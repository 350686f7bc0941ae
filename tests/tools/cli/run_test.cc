// Runs of a suite: the same results whatever happens on the way.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <set>

#include "models/foundation/atomic_file.h"
#include "tests/support/folders.h"
#include "tests/tools/cli/in_a_folder.h"
#include "tests/tools/cli/little_files.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// 40 realizations of Algorithm 1 and least squares: long enough to be hit in the middle.
std::string SuiteText() {
  return TableOneSuite(40,
                       "  - {name: nominal-ls}\n"
                       "  - {name: energy-als, label: em, options: {iterations: 20},\n"
                       "     claim: {source: us, rmse: 0.5}}\n");
}

class Run : public WithASuite {
 protected:
  void SetUp() override { WriteWholeFile(suite_, SuiteText()); }
  std::string Results(const std::string& directory) const {
    return File(directory + "/results.csv");
  }
  nlohmann::json Board(const std::string& directory) const { return Json({"compare", directory}); }

  /// Labels of the rows of a board.
  std::vector<std::string> RowsOf(const std::string& directory) const {
    const auto board = Board(directory);
    std::vector<std::string> rows;
    for (const auto& row : board.at("rows")) rows.push_back(row.at("identifier"));
    return rows;
  }

  /// The files of two runs whose bytes differ, or that one side lacks.
  std::set<std::string> Different(const std::string& a, const std::string& b) const {
    const auto left = FilesOf(a), right = FilesOf(b);
    std::set<std::string> different;
    for (const auto& [path, bytes] : left) {
      if (!right.contains(path) || right.at(path) != bytes) different.insert(path);
    }
    for (const auto& [path, bytes] : right) {
      if (!left.contains(path)) different.insert(path);
    }
    return different;
  }
};

TEST_F(Run, EveryFileHasTheSameBytesForAnyNumberOfThreads) {
  Call(Command("one", {"--jobs", "1", "--keep-recordings"}));
  EXPECT_EQ(FilesOf("one").size(), 4u + 2 * 40u);
  for (const std::string jobs : {"2", "8"}) {
    Call(Command(jobs, {"--jobs", jobs, "--keep-recordings"}));
    EXPECT_THAT(Different("one", jobs), testing::IsEmpty());
  }
}

TEST_F(Run, TakesSeedsOf64BitsAndNoNegativeOnes) {
  const std::string largest = "18446744073709551615";
  Call(Command("run", {"--realizations", "2", "--seed", largest}));
  Call({"compare", "run"});  // reads its own suite.yaml
  for (const std::string seed : {"-1", "18446744073709551616", "1.5"}) {
    EXPECT_THAT(Refusal(Command("none", {"--seed", seed})), HasSubstr("--seed: is '" + seed + "'"));
  }
}

TEST_F(Run, AnEditedCopyOfTheSuiteIsNotBelieved) {
  Call(Command("run", {"--realizations", "2"}));
  const std::string copy = at("run/suite.yaml");
  std::string text = ReadWholeFile(copy);
  text.resize(text.find("  - {name: energy-als"));
  WriteWholeFile(copy, text);
  const ProgramAnswer answer = Call({"compare", "run", "--format", "json"});
  EXPECT_EQ(nlohmann::json::parse(answer.out).at("rows").size(), 2u);
  EXPECT_THAT(answer.err, HasSubstr("suite.yaml was edited"));
  EXPECT_EQ(Call({"compare", "run", "--quiet"}).err, "") << "it is a notice";
}

TEST_F(Run, GivesTheSameBytesAfterBeingKilledAgainAndAgain) {
  Call(Command("whole"));

  // each start is killed a little later, so that some realizations are in and others are not
  for (const double delay : {0.03, 0.08, 0.15, 0.3}) {
    RunAndSignal(Command("killed", {"--jobs", "1"}), SIGKILL, delay);
  }
  Call(Command("killed"));
  EXPECT_THAT(Different("killed", "whole"), testing::IsEmpty());
}

TEST_F(Run, IsInterruptedWithStatus130AndGoesOn) {
  Call(Command("whole", {"--realizations", "2000"}));
  EXPECT_EQ(RunAndSignal(Command("stopped", {"--realizations", "2000"}), SIGINT, 0.4), 130);
  EXPECT_FALSE(std::filesystem::exists(at("stopped") + "/results.csv"));
  Call(Command("stopped", {"--realizations", "2000"}));
  EXPECT_EQ(Results("stopped"), Results("whole"));
}

TEST_F(Run, AnotherRunInTheSameDirectoryIsRefusedWithWhatDiffers) {
  Call(Command("run", {"--realizations", "2"}));
  const std::string results = Results("run");
  EXPECT_THAT(Refusal(Command("run", {"--realizations", "3"})),
              HasSubstr("realizations: 2 in the directory, 3 asked"));
  EXPECT_THAT(Refusal(Command("run", {"--realizations", "2", "--seed", "9"})),
              HasSubstr("seed: 3 in the directory, 9 asked"));
  EXPECT_THAT(Refusal(Command("run", {"--realizations", "2", "--identifier", "em"})),
              HasSubstr("identifiers"));
  EXPECT_EQ(Results("run"), results);
  Call(Command("run", {"--realizations", "2"}));  // the same run
}

TEST_F(Run, ShardsMergeToTheBytesOfTheWhole) {
  Call(Command("whole"));
  Call(Command("first", {"--shard", "1/2"}));
  Call(Command("second", {"--shard", "2/2"}));
  Call({"merge", "first", "second", "-o", "merged"});
  EXPECT_THAT(Different("merged", "whole"), testing::IsEmpty());
  EXPECT_LT(Results("first").size(), Results("whole").size());

  EXPECT_THAT(Refusal({"merge", "first", "first", "-o", "twice"}),
              HasSubstr("holds realization 0, which another shard"));
  EXPECT_FALSE(std::filesystem::exists(at("twice"))) << "left behind";

  const ProgramAnswer half = Call({"merge", "second", "-o", "half"});
  EXPECT_THAT(half.out, HasSubstr("20 of 40 realizations"));
  EXPECT_THAT(half.err, HasSubstr("no shard holds 20 realizations (0, 1, 2"));
}

TEST_F(Run, ReplaysOneRealizationBitForBit) {
  Call(Command("run", {"--realizations", "4", "--keep-recordings"}));
  Call({"simulate", "--from", "run", "--realization", "3", "-o", "replay"});
  EXPECT_EQ(File("replay/truth.json"), File("run/recordings/variant-0/realization-3.truth.json"));
  EXPECT_THAT(Refusal({"simulate", "--from", "run", "--realization", "4", "-o", "none"}),
              HasSubstr("has 0 to 3"));
}

TEST_F(Run, IdentifiersOfOthersStandBesideOurs) {
  const std::string theirs =
      "theirs=sh -c 'echo $1 > {estimate} < {recording}' sh "
      "'{\"status\": \"ok\", \"parameters\": {\"viscous\": {\"value\": 5, \"unit\": "
      "\"N.m.s/rad\", \"std\": null, \"interval95\": null}}}'";
  const std::string broken = "broken=false {recording} {estimate}";
  ASSERT_EQ(RunWarmjoint(Command("run", {"--realizations", "3", "--identifier", theirs,
                                         "--identifier", broken, "--identifier", "nominal-ls"}))
                .status,
            5)
      << "one of them answered in no realization";
  const auto board = Board("run");
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
  const ProgramAnswer verdicts =
      Call(Command("run", {"--realizations", "2", "--identifier", "nominal-ls"}));
  EXPECT_THAT(verdicts.out, HasSubstr("2 results, 2 rejected by their own tests;"));
  const ProgramAnswer silence = RunWarmjoint(Command(
      "silent", {"--realizations", "2", "--identifier", "broken=false {recording} {estimate}"}));
  EXPECT_EQ(silence.status, 5);
  EXPECT_THAT(silence.out, HasSubstr("2 results, 2 without an answer;"));
  EXPECT_THAT(
      silence.err,
      HasSubstr("broken answered in no realization; the first time: crashed: exit status 1"));
}

TEST_F(Run, SaysOfTheWholeWhatItsShardsDoNot) {
  const std::vector<std::string> more{"--realizations", "2", "--identifier",
                                      "broken=false {recording} {estimate}"};
  Call(With(Command("first", more), {"--shard", "1/2"}));
  Call(With(Command("second", more), {"--shard", "2/2"}));
  Call({"merge", "first", "-o", "half"});
  const ProgramAnswer whole = Program({"merge", "first", "second", "-o", "whole"});
  EXPECT_EQ(whole.status, 5);
  EXPECT_THAT(whole.err, HasSubstr("broken answered in no realization"));

  const auto planned = With(Command("planned", more), {"--local-shards", "1", "--shards", "2"});
  const ProgramAnswer first = Program(planned);
  EXPECT_EQ(first.status, 5) << first.err;
  Call({"status", "planned"});
  EXPECT_EQ(Program(planned).status, 5) << "also when all is there";
}

/// A script beside the suite that answers with a level.
const char* const kMine =
    "head -1 $1 | grep -q ^time, || exit 1\n"
    "echo '{\"status\": \"ok\", \"parameters\": {\"coulomb\": {\"value\": 15, \"unit\": "
    "\"N.m\",'\\\n"
    "  '\"std\": null, \"interval95\": null}}}' > $2\n";

TEST_F(Run, ACommandJoinsTheSuitesIdentifiersWithItsFilesByBareName) {
  WriteWholeFile(at("mine.sh"), kMine);
  const ProgramAnswer added =
      Call({"run", "little.yaml", "-o", "added", "--realizations", "2", "--identifier",
            "+mine=sh mine.sh {recording} {estimate}", "--identifier", "+energy-ml"});
  EXPECT_THAT(RowsOf("added"),
              testing::UnorderedElementsAre("nominal-ls", "em", "mine", "energy-ml"));
  EXPECT_THAT(added.out, HasSubstr("8 results"));
  EXPECT_THAT(added.out, Not(HasSubstr("without an answer")));
  EXPECT_THAT(Refusal({"run", "little.yaml", "-o", "twice", "--identifier",
                       "+em=sh mine.sh {recording} {estimate}"}),
              HasSubstr("there is a 'em' already"));
}

TEST_F(Run, ACommandOfASuiteFindsItsFilesBesideTheSuite) {
  WriteWholeFile(at("mine.sh"), kMine);
  WriteWholeFile(suite_, SuiteText() +
                             "  - {name: mine, command: \"sh mine.sh {recording} "
                             "{estimate}\"}\n");
  EXPECT_THAT(Refusal(Command("run", {"--realizations", "2"})), HasSubstr("--allow-commands"));
  // from a folder that does not hold them
  const ProgramAnswer allowed =
      RunWarmjoint(Command("run", {"--realizations", "2", "--allow-commands"}));
  EXPECT_EQ(allowed.status, 0) << allowed.err;
  EXPECT_THAT(allowed.err, Not(HasSubstr("warning"))) << "the suite stays hidden from it";
  EXPECT_THAT(RowsOf("run"), testing::Contains("mine"));

  // its own copy of the suite is the same run
  Call({"run", "run/suite.yaml", "-o", "run", "--allow-commands"});
}

TEST_F(Run, NoticesJointsThatDoNotFollow) {
  WriteWholeFile(suite_,
                 "question: Does it follow?\nrealizations: 2\nscenario:\n  plant: mujoco\n"
                 "  robot: rotary\n  joint: hinge\n"
                 "  friction: {law: coulomb, parameters: {coulomb: 15}}\n"
                 "  motion: {speeds: [0.1, 0.2], hold: 10}\n  timestep: 0.002\n  duration: 100\n"
                 "ladder: {variable: controller.bandwidth, values: [5, 100]}\n"
                 "identifiers:\n  - {name: nominal-ls}\n");
  const ProgramAnswer answer = RunWarmjoint(Command("run"));
  EXPECT_THAT(answer.err, HasSubstr("in 2 of 4 simulated realizations the joint did not follow"));
  EXPECT_THAT(answer.err, HasSubstr("of 5 the joint reached its commanded speed in"));
  // (2 * 15 / 0.1) / 0.895 / 5.4 = 62.1 rad/s
  EXPECT_THAT(answer.err, HasSubstr("set controller.bandwidth to 63 rad/s"));
}

TEST_F(Run, ComparesInEveryFormat) {
  Call(Command("run", {"--realizations", "5"}));
  const auto board = Board("run");
  EXPECT_EQ(board.at("suite"), "little");
  EXPECT_EQ(board.at("realizations"), 5);
  ASSERT_EQ(board.at("rows").size(), 2u);
  for (const auto& row : board.at("rows")) EXPECT_EQ(row.at("runs"), 5);
  EXPECT_THAT(Program({"compare", "run"}).out, HasSubstr("em: the claim is RMSE 0.5"));
  EXPECT_THAT(Program({"compare", "run", "--format", "markdown"}).out, HasSubstr("| nominal-ls |"));
  EXPECT_THAT(Program({"compare", "run", "--format", "csv"}).out, HasSubstr("\nall,nominal-ls,5,"));
}

TEST_F(Run, CommandsOfASuiteNeedConsent) {
  const std::string entry =
      "  - {name: external, label: theirs, options: {command: \"touch P {recording} "
      "{estimate}\"}}\n";
  WriteWholeFile(suite_, SuiteText() + entry);
  EXPECT_THAT(
      Refusal(Command("run", {"--realizations", "2"})),
      testing::AllOf(HasSubstr("runs the command 'touch P"), HasSubstr("--allow-commands")));
  EXPECT_FALSE(std::filesystem::exists(at("run")));
  // where others are chosen, it is not run
  Call(Command("ours", {"--realizations", "2", "--identifier", "em"}));

  // touch answers nothing: the run is complete and says so
  const ProgramAnswer allowed =
      RunWarmjoint(Command("run", {"--realizations", "2", "--allow-commands"}));
  EXPECT_EQ(allowed.status, 5);
  EXPECT_THAT(allowed.err, HasSubstr("theirs answered in no realization"));
  EXPECT_THAT(allowed.err, HasSubstr("sandbox: "));
}

/// A process in which Landlock is as absent as on an old kernel.
int WithoutLandlock(const std::vector<std::string>& arguments, const std::string& err) {
  const pid_t child = fork();
  if (child == 0) {
    sock_filter filter[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                            BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_landlock_create_ruleset, 0, 1),
                            BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS),
                            BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
    const sock_fprog program{std::size(filter), filter};
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
    std::vector<std::string> words = arguments;
    words.insert(words.begin(), test::BuildFolder() / "warmjoint");
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    execv(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(Run, CommandsNeedConsentToRunWithoutLandlock) {
  WriteWholeFile(at("mine.sh"), kMine);
  WriteWholeFile(
      suite_, SuiteText() + "  - {name: mine, command: \"sh mine.sh {recording} {estimate}\"}\n");
  const std::string err = at("err");
  std::vector<std::string> command = Command("run", {"--realizations", "2", "--allow-commands"});
  EXPECT_EQ(WithoutLandlock(command, err), 2);
  EXPECT_THAT(ReadWholeFile(err), HasSubstr("give --unconfined"));
  EXPECT_FALSE(std::filesystem::exists(at("run")));
  command.push_back("--unconfined");
  EXPECT_EQ(WithoutLandlock(command, err), 0);
  EXPECT_THAT(ReadWholeFile(err), HasSubstr("warning: commands run unconfined"));
}

}  // namespace
}  // namespace warmjoint
