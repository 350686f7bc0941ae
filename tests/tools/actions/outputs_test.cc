// Outputs of the program: where they may go, and what is told when they cannot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/support/folders.h"
#include "tests/tools/cli/in_a_folder.h"
#include "tests/tools/cli/little_files.h"

namespace warmjoint {
namespace {

using testing::HasSubstr;

/// Exit status of a line of bash; $W in it is the program.
int StatusOf(const std::string& line) {
  const std::string program = test::BuildFolder() / "warmjoint";
  const int status = std::system(("W='" + program + "' bash -c '" + line + "'").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

TEST(Outputs, LostWordsAreToldWithStatus4) {
  EXPECT_EQ(StatusOf("$W list laws > /dev/full 2>/dev/null"), 4);
  EXPECT_EQ(StatusOf("$W list identifiers --format json > /dev/full 2>/dev/null"), 4);
  EXPECT_EQ(StatusOf("$W --help > /dev/full 2>/dev/null"), 4);
  EXPECT_EQ(StatusOf("$W list laws >&- 2>/dev/null"), 4);
  // the reader has ended before the program begins to write
  EXPECT_EQ(StatusOf("(sleep 0.2; $W list laws 2>/dev/null) | true; exit ${PIPESTATUS[0]}"), 4);
}

TEST(Outputs, AFullStandardErrorChangesNoRefusal) {
  EXPECT_EQ(StatusOf("$W check no-such.csv 2>/dev/full"), 2);
}

TEST(Outputs, MessagesAreOneLineThatNoTerminalActsOn) {
  const ProgramAnswer answer = RunWarmjoint({"check", "no\npe\x1b[31m.csv"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, HasSubstr("no\\x0Ape\\x1B[31m.csv"));
  EXPECT_EQ(std::count(answer.err.begin(), answer.err.end(), '\n'), 1);
}

class IdentifyOutputs : public InAFolder {
 protected:
  IdentifyOutputs() { WriteRecordingFile(log_, 480); }

  ProgramAnswer Identify(const std::vector<std::string>& more) const {
    std::vector<std::string> command{"identify", log_, "--identifier", "nominal-ls"};
    command.insert(command.end(), more.begin(), more.end());
    return RunWarmjoint(command);
  }

  std::string log_ = at("log.csv");
};

TEST_F(IdentifyOutputs, NeverGoOntoAnInputOrOntoEachOther) {
  const std::string log = ReadWholeFile(log_);
  std::filesystem::create_symlink(log_, at("link.csv"));
  for (const std::string& target : {log_, at("link.csv"), at("./log.csv")}) {
    const ProgramAnswer answer = Identify({"-o", target});
    EXPECT_EQ(answer.status, 2);
    EXPECT_THAT(answer.err, HasSubstr("is an input too"));
    EXPECT_EQ(ReadWholeFile(log_), log);
  }
  EXPECT_THAT(Identify({"-o", at("x"), "--mjcf", at("x")}).err, HasSubstr("two outputs"));
}

TEST_F(IdentifyOutputs, LeaveDevicesPipesAndModesAsTheyAre) {
  // a device of our own, since a mistake here would cost the machine its /dev/null
  if (mknod(at("nul").c_str(), S_IFCHR | 0666, makedev(1, 3)) == 0) {
    EXPECT_THAT(Identify({"-o", at("nul")}).err, HasSubstr("is no regular file"));
    EXPECT_TRUE(std::filesystem::is_character_file(at("nul")));
  }
  ASSERT_EQ(mkfifo(at("pipe").c_str(), 0600), 0);
  EXPECT_EQ(Identify({"-o", at("pipe")}).status, 2);
  EXPECT_TRUE(std::filesystem::is_fifo(at("pipe")));

  WriteWholeFile(at("secret.json"), "");
  std::filesystem::permissions(at("secret.json"), std::filesystem::perms(0600));
  ASSERT_EQ(Identify({"-o", at("secret.json")}).status, 0);
  struct stat status {};
  stat(at("secret.json").c_str(), &status);
  EXPECT_EQ(status.st_mode & 07777, 0600u);
}

TEST_F(IdentifyOutputs, GoToStandardOutputAloneWhereAsked) {
  for (const char* name : {"-", "/dev/stdout"}) {
    const ProgramAnswer answer = Identify({"-o", name});
    ASSERT_EQ(answer.status, 0) << answer.err;
    EXPECT_EQ(nlohmann::json::parse(answer.out).at("status"), "ok");
    EXPECT_THAT(answer.err, HasSubstr("nominal-ls: ok"));
  }
}

TEST_F(IdentifyOutputs, FollowNoLinksThatWerePlantedForTheirTemporaryNames) {
  WriteWholeFile(at("victim"), "dear");
  // the names that earlier versions used, for all processes that may come
  for (int pid = getpid(); pid < getpid() + 2000; ++pid) {
    std::filesystem::create_symlink(at("victim"), at(".o." + std::to_string(pid) + ".part.json"));
  }
  ASSERT_EQ(Identify({"-o", at("o.json")}).status, 0);
  EXPECT_EQ(ReadWholeFile(at("victim")), "dear");
  EXPECT_TRUE(std::filesystem::is_regular_file(std::filesystem::symlink_status(at("o.json"))));
}

TEST_F(IdentifyOutputs, AFileLimitIsStatus4AndLeavesNothing) {
  const std::string line = "ulimit -f 0; $W identify " + log_ + " --identifier nominal-ls -o " +
                           at("o.json") + " >/dev/null 2>&1";
  EXPECT_EQ(StatusOf(line), 4);
  EXPECT_FALSE(std::filesystem::exists(at("o.json")));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch_.path()), {}), 1);
}

}  // namespace
}  // namespace warmjoint
