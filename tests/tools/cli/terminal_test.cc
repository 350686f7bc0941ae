// The program on a terminal and in a pipe: colours, progress.
#include <gmock/gmock.h>

#include <filesystem>

#include "models/foundation/atomic_file.h"
#include "tests/support/folders.h"
#include "tests/tools/cli/in_a_folder.h"
#include "tests/tools/cli/little_files.h"

namespace warmjoint {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kEscape = "\033[";

/// The widest of what progress lines showed, in ASCII: each but the last return begins one. Where a line ends, a command
/// printed other words after it had cleared its progress.
size_t WidestProgress(const std::string& shown) {
  const std::string redraw = "\r\033[K";
  size_t widest = 0, begin = shown.find(redraw);
  while (begin != std::string::npos) {
    begin += redraw.size();
    const size_t end = shown.find(redraw, begin);
    const bool printed = shown.substr(begin, end - begin).find('\n') != std::string::npos;
    if (end != std::string::npos && !printed) widest = std::max(widest, end - begin);
    begin = end;
  }
  return widest;
}

class Terminal : public InAFolder {
 protected:
  /// Ten minutes at three speeds in both directions, cold and without warming.
  void WriteLog(int samples) const {
    WriteRecordingFile(at("log.csv"), samples, [](int i) {
      const double speeds[]{0.2, -0.5, 1.0, -0.2, 0.5, -1.0};
      return speeds[i / 20 % 6];
    });
  }
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

TEST_F(OnTerminal, VerdictHasItsColourWhereOneIsWanted) {
  WriteLog(600);
  const std::vector<std::string> command{"identify", "log.csv", "--identifier", "nominal-ls"};
  const ProgramAnswer shown = On(80, command);
  EXPECT_THAT(shown.out, HasSubstr(kEscape));
  EXPECT_THAT(On(80, command, {{"TERM", "xterm"}, {"NO_COLOR", "1"}}).out, Not(HasSubstr(kEscape)));
  EXPECT_THAT(On(80, command, {{"TERM", "dumb"}}).out, Not(HasSubstr(kEscape)));
  EXPECT_THAT(Program(command).out, Not(HasSubstr(kEscape)));
}

TEST_F(Terminal, QuietLeavesOutNoticesAndKeepsResultsAndErrors) {
  WriteLog(600);
  WriteWholeFile(at("warmjoint.yaml"), "gear: 2\n");
  const ProgramAnswer told = Program({"check", "log.csv"});
  EXPECT_THAT(told.err, HasSubstr("gear"));  // what the project file sets
  for (const char* flag : {"-q", "--quiet"}) {
    for (const ProgramAnswer& answer :
         {Program({flag, "check", "log.csv"}), Program({"check", "log.csv", flag})}) {
      EXPECT_EQ(answer.err, "");
      EXPECT_EQ(answer.out, told.out);
    }
  }
  EXPECT_THAT(Refusal({"-q", "check", "missing.csv"}), HasSubstr("missing.csv"));
}

TEST_F(OnTerminal, MachinesReadWhatIsNeverColoured) {
  WriteLog(600);
  const std::vector<std::string> command{"check", "log.csv", "--format", "json"};
  std::string shown = On(30, command).out;
  std::erase(shown, '\r');  // what a terminal makes of a line end
  EXPECT_EQ(shown, Program(command).out);
}

TEST_F(OnTerminal, ProgressOfARunStaysOnOneLine) {
  WriteWholeFile(at("little.yaml"),
                 TableOneSuite(30,
                               "  - {name: energy-als, options: {iterations: 60}}\n"
                               "  - {name: energy-ml}\n  - {name: nominal-ls}\n"));
  const ProgramAnswer shown = On(40, {"run", "little.yaml", "-o", "run", "--jobs", "1"});
  EXPECT_EQ(shown.status, 0);
  EXPECT_THAT(shown.out, HasSubstr("/30 realizations"));
  EXPECT_LT(WidestProgress(shown.out), 40u);
}

TEST_F(OnTerminal, IdentifyTellsWhatItIsAtFromTheFirstSecondOn) {
  // several seconds
  WriteLog(400000);
  const ProgramAnswer shown = On(60, {"identify", "log.csv", "--identifier", "auto"});
  EXPECT_THAT(shown.out, HasSubstr("fitting auto to 400000 samples"));
  EXPECT_LT(WidestProgress(shown.out), 60u);
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
  EXPECT_FALSE(std::filesystem::exists(at("estimate.json")));
}

}  // namespace
}  // namespace warmjoint
