// Commands that try to outlive, outgrow or outwit what holds them.
#include "tools/suite/run_command.h"

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

#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

CommandTask Line(const std::string& line, double seconds = 20) {
  CommandTask task;
  task.arguments = {"/bin/sh", "-c", line};
  task.answer = "answer";
  task.limits.seconds = seconds;
  if (LandlockVersion() == 0) task.confinement = Confinement::none;
  return task;
}

/// A folder with what a command must not see; working directories are made in another.
class Commands : public testing::Test {
 protected:
  void SetUp() override { setenv("TMPDIR", temporary_.path().c_str(), 1); }
  void TearDown() override {
    unsetenv("TMPDIR");
    EXPECT_TRUE(fs::is_empty(temporary_.path())) << "no directory of a command stays";
  }

  ScratchDirectory temporary_;
  ScratchDirectory other_;
};

/// Whether a process of the system has `mark` among its arguments.
bool Lives(const std::string& mark) {
  for (const auto& entry : fs::directory_iterator("/proc")) {
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

TEST_F(Commands, StartInADirectoryWithTheirFilesAloneAndLeaveAnAnswer) {
  CommandTask task = Line("ls; cp recording.csv answer; echo $TMPDIR; pwd; exit 4");
  task.files = {{"recording.csv", "read"}};
  const CommandEnd end = RunCommand(task);
  EXPECT_EQ(end.status, 4);
  EXPECT_EQ(end.last_output, ".") << "its own directory, under no drawn name";
  EXPECT_EQ(end.kind, AnswerKind::whole);
  EXPECT_EQ(end.answer, "read");
  EXPECT_EQ(RunCommand(Line("ln -s /etc/passwd answer")).kind, AnswerKind::no_file);
}

TEST_F(Commands, LeaveNoProcessHoweverTheyEnd) {
  const std::string mark = DrawnSleep();
  const std::string children =
      "sleep " + mark + " & setsid sleep " + mark + " & (setsid setsid sleep " + mark + " &) ; ";
  const auto ending = [](const std::string& line) { return RunCommand(Line(line, 0.3)).ending; };
  EXPECT_EQ(RunCommand(Line(children + "exit 3")).status, 3);
  EXPECT_FALSE(Lives(mark));
  EXPECT_EQ(ending(children + "sleep " + mark), CommandEnding::timeout);
  EXPECT_FALSE(Lives(mark));
  EXPECT_EQ(ending("trap '' TERM INT HUP; " + children + "while :; do :; done"),
            CommandEnding::timeout);
  EXPECT_FALSE(Lives(mark));
}

TEST_F(Commands, EndWithTheProgramThatIsKilledAndSoDoTheirDirectories) {
  const std::string mark = DrawnSleep();
  const pid_t program = fork();
  if (program == 0) {
    RunCommand(Line("setsid sleep " + mark + " & sleep " + mark));
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
  EXPECT_TRUE(wait([&] { return !Lives(mark) && fs::is_empty(temporary_.path()); }));
}

TEST_F(Commands, HaveBoundedOutputProcessesMemoryFilesAndAnswers) {
  const CommandEnd long_line = RunCommand(Line("head -c 30000000 /dev/zero | tr '\\0' x; exit 4"));
  EXPECT_EQ(long_line.status, 4);
  EXPECT_LE(long_line.last_output.size(), 4096u);
  CommandTask task = Line("yes");
  task.limits.output = 1 << 20;
  EXPECT_EQ(RunCommand(task).ending, CommandEnding::output);
  task = Line("b() { b | b & }; b; sleep 30");
  task.limits.processes = 16;
  EXPECT_EQ(RunCommand(task).ending, CommandEnding::processes);
  task = Line("head -c 2000000 /dev/zero > answer; stat -c %s answer");
  task.limits.file = 1 << 20;
  EXPECT_EQ(RunCommand(task).last_output, "1048576");
  task.limits.answer = 1 << 19;
  EXPECT_EQ(RunCommand(task).kind, AnswerKind::too_large);
  task = Line("x=$(head -c 200000000 /dev/zero | tr '\\0' x)");
  task.limits.memory = 64 << 20;
  EXPECT_NE(RunCommand(task).status, 0);
}

TEST_F(Commands, ThatCannotBeStartedHaveTheStatusOfAShell) {
  CommandTask task = Line("");
  task.arguments = {"/no/such/program"};
  EXPECT_EQ(RunCommand(task).status, 127);
  task.arguments = {"/etc/passwd"};
  EXPECT_EQ(RunCommand(task).status, 126);
}

/// Ways to come by the truth: lines of shell that print "truth" where they succeed.
constexpr const char* kCheats[]{
    // memory, command line, environment, descriptors and root of the parent
    "dd if=/proc/@PID/mem bs=1 skip=@AT count=15 2>/dev/null; echo",
    "tr '\\0' ' ' < /proc/@PID/cmdline | grep -q . && echo truth",
    "tr '\\0' ' ' < /proc/@PID/environ | grep -q . && echo truth", "cat /proc/@PID/fd/@FD; echo",
    "cat /proc/@PID/root@DIR/suite.yaml; echo",
    // the run's directory, a recording of another task, the store
    "cat @DIR/suite.yaml; echo", "cat @DIR/warmjoint_other/recording.csv; echo",
    "cp @DIR/results.sqlite mine && cat mine; echo"};

TEST_F(Commands, ThatCheatSucceedUnconfinedAndGetNothingInTheSandbox) {
  if (LandlockVersion() == 0) GTEST_SKIP() << "this kernel has no Landlock";
  // what the program has: files, a descriptor, an environment, arguments, memory
  const std::string file = other_.path() / "suite.yaml";
  std::ofstream(file) << "truth";
  fs::create_directory(other_.path() / "warmjoint_other");
  std::ofstream(other_.path() / "warmjoint_other/recording.csv") << "truth";
  std::ofstream(other_.path() / "results.sqlite") << "truth";
  setenv("WARMJOINT_SECRET", "truth", 1);
  const int descriptor = open(file.c_str(), O_RDONLY);
  static volatile char memory[] = "truth in memory";

  for (std::string line : kCheats) {
    const auto put = [&line](const std::string& mark, const std::string& text) {
      for (size_t at; (at = line.find(mark)) != std::string::npos;)
        line.replace(at, mark.size(), text);
    };
    put("@DIR", other_.path());
    put("@PID", std::to_string(getpid()));
    put("@FD", std::to_string(descriptor));
    put("@AT", std::to_string(reinterpret_cast<std::uintptr_t>(&memory[0])));
    CommandTask task = Line(line);
    EXPECT_THAT(RunCommand(task).last_output, testing::Not(HasSubstr("truth"))) << line;
    task.confinement = Confinement::none;
    EXPECT_THAT(RunCommand(task).last_output, HasSubstr("truth")) << line;
  }
  close(descriptor);
}

TEST_F(Commands, GetNeitherTheEnvironmentNorTheDescriptorsOfTheProgram) {
  setenv("WARMJOINT_SECRET", "truth", 1);
  std::ofstream(other_.path() / "secret") << "truth";
  const int descriptor = open((other_.path() / "secret").c_str(), O_RDONLY);  // not closed on exec
  CommandTask task = Line("env | grep SECRET; cat <&" + std::to_string(descriptor));
  task.confinement = Confinement::none;
  EXPECT_EQ(RunCommand(task).last_output.find("truth"), std::string::npos);
  close(descriptor);
}

TEST_F(Commands, WriteNowhereElseAndReachNoNetworkAndNoProcess) {
  if (LandlockVersion() < 6) GTEST_SKIP() << "this kernel's Landlock does not hold signals";
  std::ofstream(other_.path() / "recording.csv") << "honest";
  const std::string there = (other_.path() / "recording.csv").string();
  RunCommand(Line("echo > " + there + "; truncate -s 0 " + there + "; rm " + there));
  EXPECT_EQ(fs::file_size(there), 6u);
  EXPECT_EQ(RunCommand(Line("echo > /tmp/mine || echo > /dev/shm/mine || exit 5")).status, 5);
  EXPECT_EQ(RunCommand(Line("kill -9 -1; kill -9 $PPID; kill -9 " + std::to_string(getpid()) +
                            "; echo held"))
                .last_output,
            "held");
  if (!fs::exists("/usr/bin/python3")) return;
  const std::string connect =
      "/usr/bin/python3 -c \"import socket; socket.create_connection(('127.0.0.1', 1))\"";
  EXPECT_THAT(RunCommand(Line(connect)).last_output, HasSubstr("PermissionError"));
}

}  // namespace
}  // namespace warmjoint
