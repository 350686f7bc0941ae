// The program on a terminal and in a pipe: widths, colours, progress.
#include <gmock/gmock.h>

#include <filesystem>

#include "models/foundation/atomic_file.h"
#include "tests/support/folders.h"
#include "tests/tools/cli/recording_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/cli/table_one_yaml.h"
#include "tests/tools/scratch_directory.h"
#include "tools/terminal/wrap.h"

namespace warmjoint {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kEscape = "\033[";

/// The widest of what stands between line ends and returns; erasing a line takes no room.
int WidestRow(std::string shown) {
  int widest = 0;
  const std::string erase = "\033[K";
  for (size_t at; (at = shown.find(erase)) != std::string::npos;) shown.erase(at, erase.size());
  for (char& c : shown) c = c == '\r' ? '\n' : c;
  for (const std::string& row : Lines(shown)) widest = std::max(widest, ShownWidth(row));
  return widest;
}

class Terminal : public testing::Test {
 protected:
  /// Ten minutes at three speeds in both directions, cold and without warming.
  void WriteLog(int samples) const {
    WriteRecordingFile(scratch_.path() / "log.csv", samples, [](int i) {
      const double speeds[]{0.2, -0.5, 1.0, -0.2, 0.5, -1.0};
      return speeds[i / 20 % 6];
    });
  }

  ScratchDirectory scratch_;
};

/// Those that need a real terminal.
class OnTerminal : public Terminal {
 protected:
  void SetUp() override {
    if (!TerminalsCanBeOpened()) GTEST_SKIP() << "no pseudo-terminal can be opened here";
  }

  ProgramAnswer On(int columns, const std::vector<std::string>& arguments,
                   const std::map<std::string, std::string>& environment = {
                       {"TERM", "xterm"}}) const {
    return RunOnTerminal(arguments, columns, {scratch_.path(), environment});
  }
};

const std::vector<std::vector<std::string>> kHelpAndLists{
    {"--help"},           {"run", "--help"},       {"identify", "--help"},
    {"list", "laws"},     {"list", "identifiers"}, {"list", "identifiers", "position-ridge"},
    {"list", "suites"},   {"list", "robots"},      {"list", "suites", "table1"},
    {"help", "simulate"}, {"attach", "--help"}};

TEST_F(Terminal, HelpAndListsFitTheirWidthInAPipe) {
  for (const auto& command : kHelpAndLists) {
    const ProgramAnswer answer = RunWarmjoint(command);
    EXPECT_EQ(answer.status, 0);
    EXPECT_NE(answer.out, "") << command[0] << " " << command.back();
    EXPECT_LE(WidestRow(answer.out), 80) << command[0] << " " << command.back();
  }
}

TEST_F(OnTerminal, HelpAndListsFitTheirWidth) {
  for (const auto& command : kHelpAndLists) {
    const ProgramAnswer shown = On(80, command);
    EXPECT_NE(shown.out, "") << command[0] << " " << command.back();
    EXPECT_LE(WidestRow(shown.out), 80) << command[0] << " " << command.back();
  }
}

TEST_F(OnTerminal, VerdictHasItsColourWhereOneIsWanted) {
  WriteLog(600);
  const std::vector<std::string> command{"identify", "log.csv", "--identifier", "nominal-ls"};
  const ProgramAnswer shown = On(80, command);
  EXPECT_THAT(shown.out, HasSubstr(kEscape));
  EXPECT_LE(WidestRow(shown.out), 80);
  EXPECT_THAT(On(80, command, {{"TERM", "xterm"}, {"NO_COLOR", "1"}}).out, Not(HasSubstr(kEscape)));
  EXPECT_THAT(On(80, command, {{"TERM", "dumb"}}).out, Not(HasSubstr(kEscape)));
  EXPECT_THAT(RunWarmjoint(command, {scratch_.path(), {}}).out, Not(HasSubstr(kEscape)));
}

TEST_F(Terminal, QuietLeavesOutNoticesAndKeepsResultsAndErrors) {
  WriteLog(600);
  WriteWholeFile(scratch_.path() / "warmjoint.yaml", "gear: 2\n");
  const Surroundings here{scratch_.path(), {}};
  std::vector<std::string> command{"check", "log.csv"};
  const ProgramAnswer told = RunWarmjoint(command, here);
  EXPECT_THAT(told.err, HasSubstr("gear"));  // what the project file sets
  for (const char* flag : {"-q", "--quiet"}) {
    const ProgramAnswer before = RunWarmjoint({flag, "check", "log.csv"}, here);
    const ProgramAnswer behind = RunWarmjoint({"check", "log.csv", flag}, here);
    EXPECT_EQ(before.err, "");
    EXPECT_EQ(behind.err, "");
    EXPECT_EQ(before.out, told.out);
    EXPECT_EQ(behind.out, told.out);
  }
  const ProgramAnswer failed = RunWarmjoint({"-q", "check", "missing.csv"}, here);
  EXPECT_EQ(failed.status, 2);
  EXPECT_THAT(failed.err, HasSubstr("missing.csv"));
}

TEST_F(OnTerminal, MachinesReadWhatIsNeverWrappedOrColoured) {
  WriteLog(600);
  const std::vector<std::string> command{"check", "log.csv", "--format", "json"};
  std::string shown = On(30, command).out;
  std::erase(shown, '\r');  // what a terminal makes of a line end
  EXPECT_EQ(shown, RunWarmjoint(command, {scratch_.path(), {}}).out);
}

TEST_F(Terminal, ColumnsOfTheEnvironmentCount) {
  const ProgramAnswer narrow = RunWarmjoint({"list", "suites"}, {{}, {{"COLUMNS", "50"}}});
  EXPECT_LE(WidestRow(narrow.out), 50);
  const ProgramAnswer wide = RunWarmjoint({"list", "suites"}, {{}, {{"COLUMNS", "120"}}});
  EXPECT_GT(WidestRow(wide.out), 80);
}

TEST_F(OnTerminal, RefusalsAreWrappedThereAndOneLineInAPipe) {
  const std::vector<std::string> command{"list", "laws", "nothing-like-any-law-that-is-known-here"};
  const ProgramAnswer shown = On(50, command);
  EXPECT_EQ(shown.status, 2);
  EXPECT_LE(WidestRow(shown.out), 50);
  EXPECT_EQ(Lines(RunWarmjoint(command).err).size(), 1u);
}

TEST_F(OnTerminal, ProgressOfARunStaysOnOneLine) {
  WriteWholeFile(scratch_.path() / "little.yaml",
                 TableOneSuite(30,
                               "  - {name: energy-als, options: {iterations: 60}}\n"
                               "  - {name: energy-ml}\n  - {name: nominal-ls}\n"));
  const ProgramAnswer shown = On(40, {"run", "little.yaml", "-o", "run", "--jobs", "1"});
  EXPECT_EQ(shown.status, 0);
  EXPECT_THAT(shown.out, HasSubstr("/30 realizations"));
  EXPECT_LE(WidestRow(shown.out), 40);
}

TEST_F(OnTerminal, IdentifyTellsWhatItIsAtFromTheFirstSecondOn) {
  // several seconds
  WriteLog(400000);
  const ProgramAnswer shown = On(60, {"identify", "log.csv", "--identifier", "auto"});
  EXPECT_THAT(shown.out, HasSubstr("fitting auto to 400000 samples"));
  EXPECT_LE(WidestRow(shown.out), 60);
}

TEST_F(Terminal, AnInterruptedIdentifySaysSoAndLeavesNothing) {
  if (RunCommandLine({"sh", "-c", "command -v timeout"}).status != 0) {
    GTEST_SKIP() << "timeout is absent";
  }
  // a million samples take several seconds
  WriteLog(1000000);
  const std::string program = test::BuildFolder() / "warmjoint";
  const ProgramAnswer answer =
      RunCommandLine({"timeout", "--preserve-status", "--signal=INT", "1.5", program, "identify",
                      "log.csv", "--identifier", "auto", "-o", "estimate.json"},
                     {scratch_.path(), {}});
  EXPECT_EQ(answer.status, 130);
  EXPECT_THAT(answer.err, HasSubstr("interrupted"));
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "estimate.json"));
}

}  // namespace
}  // namespace warmjoint
