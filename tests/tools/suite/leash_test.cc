// Commands that try to outlive, outgrow or outwit what holds them.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "models/foundation/atomic_file.h"
#include "tests/tools/scratch_directory.h"
#include "tools/suite/bubble.h"
#include "tools/suite/run_command.h"

namespace warmjoint {
namespace {

using testing::HasSubstr;

/// A directory of the command's own, and one with what it must not see.
class Leash : public testing::Test {
 protected:
  CommandEnd RunLine(const std::string& line, const Wall& wall, const CommandLimits& limits) const {
    return RunCommand({"/bin/sh", "-c", line}, own_.path(), wall, limits);
  }
  CommandEnd RunLine(const std::string& line, double seconds = 20) const {
    CommandLimits limits;
    limits.seconds = seconds;
    return RunLine(line, Wall({}, own_.path()), limits);
  }

  ScratchDirectory own_;
  ScratchDirectory other_;
};

/// Whether a process of the system has `mark` among its arguments.
bool Lives(const std::string& mark) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    // one that ends meanwhile is read as far as it was
    std::ifstream file(entry.path() / "cmdline");
    for (std::string argument; std::getline(file, argument, '\0');) {
      if (argument.find(mark) != std::string::npos) return true;
    }
  }
  return false;
}

/// A number of seconds that nobody else sleeps for.
std::string DrawnSleep() {
  static int count = 0;
  return "1" + std::to_string(getpid()) + std::to_string(count++);
}

TEST_F(Leash, NothingOfACommandLivesOnHoweverItEnds) {
  const std::string mark = DrawnSleep();
  const std::string children =
      "sleep " + mark + " & setsid sleep " + mark + " & (setsid setsid sleep " + mark + " &) ; ";
  EXPECT_EQ(RunLine(children + "exit 3").status, 3);
  EXPECT_FALSE(Lives(mark));
  EXPECT_TRUE(RunLine(children + "sleep " + mark, 0.3).timed_out);
  EXPECT_FALSE(Lives(mark));
  EXPECT_TRUE(RunLine("trap '' TERM INT HUP; " + children + "while :; do :; done", 0.3).timed_out);
  EXPECT_FALSE(Lives(mark));
}

TEST_F(Leash, ACommandEndsWithTheProgramAndSoDoesItsDirectory) {
  const std::string mark = DrawnSleep();
  const pid_t program = fork();
  if (program == 0) {
    RunLine("setsid sleep " + mark + " & sleep " + mark);
    _exit(0);
  }
  const auto wait = [](auto done) {
    for (int i = 0; i < 500 && !done(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return done();
  };
  ASSERT_TRUE(wait([&] { return Lives(mark); }));
  kill(program, SIGKILL);
  waitpid(program, nullptr, 0);
  EXPECT_TRUE(wait([&] { return !Lives(mark); }));
  EXPECT_TRUE(wait([&] { return !std::filesystem::exists(own_.path()); }));
}

TEST_F(Leash, OutputIsTakenWhateverItsLengthAndLittleOfItKept) {
  const CommandEnd end = RunLine("head -c 30000000 /dev/zero | tr '\\0' x; exit 4");
  EXPECT_EQ(end.status, 4);
  EXPECT_LE(end.last_output.size(), 4096u);
}

TEST_F(Leash, ProcessesMemoryAndFilesAreBounded) {
  CommandLimits limits;
  limits.seconds = 20;
  limits.processes = 16;
  EXPECT_TRUE(RunLine("b() { b | b & }; b; sleep 30", Wall({}, own_.path()), limits).crowded);
  limits.file = 1 << 20;
  EXPECT_NE(RunLine("head -c 2000000 /dev/zero > big", Wall({}, own_.path()), limits).status, 0);
  EXPECT_EQ(std::filesystem::file_size(own_.path() / "big"), 1u << 20);
  limits.memory = 64 << 20;
  EXPECT_NE(RunLine("x=$(head -c 200000000 /dev/zero | tr '\\0' x)", Wall({}, own_.path()), limits)
                .status,
            0);
}

TEST_F(Leash, AnAbsentProgramIsStatus127) {
  EXPECT_EQ(RunCommand({"/no/such/program"}, own_.path(), Wall(), {}).status, 127);
}

/// A way to come by the truth: a line of shell that prints "truth" where it succeeds.
struct Cheat {
  const char* name;
  const char* line;
};

class Cheating : public Leash, public testing::WithParamInterface<Cheat> {};

TEST_P(Cheating, SucceedsWithoutTheWallAndGetsNothingBehindIt) {
  std::vector<WallKind> walls;
  if (WallVersion() > 0) walls.push_back(WallKind::landlock);
  if (!Bubblewrap().empty()) walls.push_back(WallKind::bubblewrap);
  if (walls.empty()) GTEST_SKIP() << "neither Landlock nor bubblewrap works here";
  // what the program has: files, a descriptor, an environment, arguments, memory
  const std::string file = other_.path() / "suite.yaml";
  std::ofstream(file) << "truth";
  std::filesystem::create_directory(other_.path() / "warmjoint_other");
  std::ofstream(other_.path() / "warmjoint_other/recording.csv") << "truth";
  std::ofstream(other_.path() / "results.sqlite") << "truth";
  setenv("WARMJOINT_SECRET", "truth", 1);
  const int descriptor = open(file.c_str(), O_RDONLY);
  static volatile char memory[] = "truth in memory";

  std::string line = GetParam().line;
  const auto put = [&line](const std::string& mark, const std::string& text) {
    for (size_t at; (at = line.find(mark)) != std::string::npos;)
      line.replace(at, mark.size(), text);
  };
  put("@DIR", other_.path());
  put("@PID", std::to_string(getpid()));
  put("@FD", std::to_string(descriptor));
  put("@AT", std::to_string(reinterpret_cast<std::uintptr_t>(&memory[0])));
  CommandLimits limits;
  EXPECT_THAT(RunLine(line, Wall(), limits).last_output, HasSubstr("truth")) << line;
  for (const WallKind kind : walls) {
    EXPECT_THAT(RunLine(line, Wall({}, own_.path(), kind), limits).last_output,
                testing::Not(HasSubstr("truth")))
        << line;
  }
  close(descriptor);
}

INSTANTIATE_TEST_SUITE_P(
    Wall, Cheating,
    testing::Values(Cheat{"MemoryOfTheParent",
                          "dd if=/proc/@PID/mem bs=1 skip=@AT count=15 2>/dev/null; echo"},
                    Cheat{"CommandLineOfTheParent",
                          "tr '\\0' ' ' < /proc/@PID/cmdline | grep -q . && echo truth"},
                    Cheat{"EnvironmentOfTheParent",
                          "tr '\\0' ' ' < /proc/@PID/environ | grep -q . && echo truth"},
                    Cheat{"DescriptorsOfTheParent", "cat /proc/@PID/fd/@FD; echo"},
                    Cheat{"RootOfTheParent", "cat /proc/@PID/root@DIR/suite.yaml; echo"},
                    Cheat{"RunDirectory", "cat @DIR/suite.yaml; echo"},
                    Cheat{"RecordingsOfOtherTasks", "cat @DIR/warmjoint_other/recording.csv; echo"},
                    Cheat{"Store", "cp @DIR/results.sqlite mine && cat mine; echo"}),
    [](const auto& cheat) { return cheat.param.name; });

TEST_F(Leash, BubblewrapLetsACommandDoItsWork) {
  if (Bubblewrap().empty()) GTEST_SKIP() << "bubblewrap is not installed, or may not work here";
  std::ofstream(own_.path() / "recording.csv") << "read";
  std::ofstream(other_.path() / "script") << "named";
  const Wall wall({other_.path() / "script"}, own_.path(), WallKind::bubblewrap);
  CommandLimits limits;
  limits.seconds = 20;
  const std::string script = other_.path() / "script";
  EXPECT_EQ(
      RunLine("cat recording.csv " + script + " > estimate.json; exit 4", wall, limits).status, 4);
  EXPECT_EQ(ReadWholeFile(own_.path() / "estimate.json"), "readnamed");

  // and ends it, with all that came of it
  const std::string mark = DrawnSleep();
  limits.seconds = 0.5;
  EXPECT_TRUE(RunLine("setsid sleep " + mark + " & sleep " + mark, wall, limits).timed_out);
  EXPECT_FALSE(Lives(mark));
}

TEST_F(Leash, TheEnvironmentAndDescriptorsOfTheProgramStayWithIt) {
  setenv("WARMJOINT_SECRET", "truth", 1);
  std::ofstream(other_.path() / "secret") << "truth";
  const int descriptor = open((other_.path() / "secret").c_str(), O_RDONLY);  // not closed on exec
  EXPECT_EQ(RunLine("env | grep SECRET; cat <&" + std::to_string(descriptor), Wall(), {})
                .last_output.find("truth"),
            std::string::npos);
  close(descriptor);
}

TEST_F(Leash, TheWallStopsWritingElsewhereAndSignals) {
  if (WallVersion() < 6) GTEST_SKIP() << "this kernel's Landlock does not hold signals";
  std::ofstream(other_.path() / "recording.csv") << "honest";
  RunLine("echo > " + (other_.path() / "recording.csv").string());
  EXPECT_EQ(std::filesystem::file_size(other_.path() / "recording.csv"), 6u);
  EXPECT_THAT(
      RunLine("kill -9 -1; kill -9 $PPID; kill -9 " + std::to_string(getpid()) + "; echo held")
          .last_output,
      HasSubstr("held"));
}

}  // namespace
}  // namespace warmjoint
