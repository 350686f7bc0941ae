#include "tools/suite/interpreter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "identification/preparation/prepare.h"
#include "identification/preparation/select.h"
#include "models/foundation/atomic_file.h"
#include "tests/tools/scratch_directory.h"
#include "tools/suite/external_command.h"
#include "tools/suite/external_identifier.h"
#include "tools/suite/wall.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// An interpreter outside of the system's folders, and a script `python3` in PATH that starts it.
class Shim : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists("/usr/bin/python3")) GTEST_SKIP() << "there is no /usr/bin/python3";
    if (BestWall() == WallKind::none) GTEST_SKIP() << "no wall stands here";
    fs::create_directory(elsewhere_.path() / "bin");
    fs::copy_file(fs::canonical("/usr/bin/python3"), interpreter_);
    Script(shims_.path() / "python3", "exec " + interpreter_.string() + " \"$@\"");
    path_ = std::getenv("PATH");
    setenv("PATH", (shims_.path().string() + ":" + path_).c_str(), 1);
  }
  void TearDown() override {
    if (!path_.empty()) setenv("PATH", path_.c_str(), 1);
  }

  static void Script(const fs::path& file, const std::string& line) {
    WriteWholeFile(file, "#!/bin/sh\n" + line + "\n");
    fs::permissions(file, fs::perms(0755));
  }

  /// Why a command of one line of Python gives no answer.
  static std::string Failure(const std::string& command, CommandForm form) {
    Measurements log;
    log.time = Eigen::VectorXd::LinSpaced(12, 0, 11);
    log.position = log.time;
    log.velocity = Eigen::VectorXd::Ones(12);
    log.torque = 2 + 0.01 * log.time.array();
    try {
      PrepareExternal(ReadExternal("a=" + command + " {recording} {estimate}", form), {})(
          Prepare(log), {});
    } catch (const NoAnswer& failure) {
      return failure.what();
    }
    return "";
  }

  const ScratchDirectory elsewhere_, shims_;
  const fs::path interpreter_ = elsewhere_.path() / "bin/python3";
  std::string path_;
};

TEST_F(Shim, IsAskedForItsInterpreter) {
  EXPECT_EQ(FindInterpreter("python3"), interpreter_);
  // what is named by its place is taken as it is, and so is what gives no answer
  EXPECT_EQ(FindInterpreter(shims_.path() / "python3"), shims_.path() / "python3");
  Script(shims_.path() / "python3.99", "exit 1");
  EXPECT_EQ(FindInterpreter("python3.99"), shims_.path() / "python3.99");
  Script(shims_.path() / "python4", "echo /no/such/program");
  EXPECT_EQ(FindInterpreter("python4"), shims_.path() / "python4");
  Script(shims_.path() / "mine", "echo /bin/sh");
  EXPECT_EQ(FindInterpreter("mine"), shims_.path() / "mine");
}

TEST_F(Shim, RunsBehindTheWall) {
  const std::string line = "python3 -c \"import json, sys; print('hello'); sys.exit(7)\"";
  for (const CommandForm form : {CommandForm::words, CommandForm::shell}) {
    EXPECT_THAT(Failure(line, form), HasSubstr("exit status 7: hello"));
  }
}

TEST_F(Shim, WhatTheWallRefusesIsToldWithItsRemedy) {
  Script(shims_.path() / "other", "exec " + interpreter_.string() + " \"$@\"");
  EXPECT_THAT(Failure("other -c 'exit(7)'", CommandForm::words),
              testing::AllOf(HasSubstr("exit status 126: "),
                             HasSubstr("name the interpreter by its full path")));
}

}  // namespace
}  // namespace warmjoint
