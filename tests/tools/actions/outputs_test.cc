// Outputs of the program: where they may go, and what is told when they cannot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
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
  return RunCommandLine({"bash", "-c", line},
                        {{}, {{"W", (test::BuildFolder() / "warmjoint").string()}}})
      .status;
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
    return RunWarmjoint(With({"identify", log_, "--identifier", "nominal-ls"}, more));
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

TEST_F(IdentifyOutputs, GoToStandardOutputAloneWhereAsked) {
  for (const char* name : {"-", "/dev/stdout"}) {
    const ProgramAnswer answer = Identify({"-o", name});
    ASSERT_EQ(answer.status, 0) << answer.err;
    EXPECT_EQ(nlohmann::json::parse(answer.out).at("status"), "ok");
    EXPECT_THAT(answer.err, HasSubstr("nominal-ls: ok"));
  }
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
