// The program on a terminal and in a pipe: colours, progress.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <regex>
#include <sstream>

#include "models/foundation/atomic_file.h"
#include "tests/support/folders.h"
#include "tests/tools/cli/in_a_folder.h"
#include "tests/tools/cli/little_files.h"
#include "tools/terminal/say.h"

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

/// The columns of the widest line, without colours.
size_t WidestLine(const std::string& text) {
  size_t widest = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    // what a progress line was cleared for stands behind the last clearing
    const size_t cleared = line.rfind("\033[K");
    if (cleared != std::string::npos) line.erase(0, cleared);
    line = std::regex_replace(line, std::regex("\033\\[[0-9;]*[mK]|\r"), "");
    widest = std::max(widest, line.size());
  }
  return widest;
}

/// The words of a text without how they are laid out.
std::vector<std::string> WordsOf(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

TEST(Wrapped, BreaksAtBlanksBelowTheTextOfALine) {
  EXPECT_EQ(Wrapped("one two three", 9), "one two\nthree");
  EXPECT_EQ(Wrapped("  one two three\nfour\n", 9), "  one two\n  three\nfour\n");
  EXPECT_EQ(Wrapped("* one two three", 9), "* one two\n  three");
  EXPECT_EQ(Wrapped("key  one two three", 12), "key  one two\n     three");
  EXPECT_EQ(Wrapped("a_word_that_is_long and more", 8), "a_word_that_is_long\nand more");
  // what takes no column does not count
  EXPECT_EQ(Wrapped("\033[1;32mok\033[0m it is \xc2\xb0", 10),
            "\033[1;32mok\033[0m it is \xc2\xb0");
  EXPECT_EQ(Wrapped("", 9), "");
}

TEST(TableToText, BreaksTheWidestCellWhereThePageIsTooNarrow) {
  const Table table{{"name", "finding"}, {{"a", "one two three four five six seven"}, {"b", "-"}}};
  EXPECT_EQ(TableToText(table, 2, {.width = 30}),
            "name  finding\n------------------------------\na     one two three four five\n"
            "      six seven\nb     -\n");
}

TEST_F(Terminal, HelpFitsAndBeginsWithAnExample) {
  for (const char* command : {"list", "new", "simulate", "convert", "check", "identify",
                              "identify-robot", "predict", "attach", "run", "status", "merge",
                              "compare", "plot", "report", "export", "compensate", "validate"}) {
    const std::string help = Call({command, "--help"}).out;
    EXPECT_LE(WidestLine(help), 80u) << help;
    // the example first, what every command has last
    const size_t example = help.find(std::string("Example: warmjoint ") + command);
    const size_t general = help.find("\nGeneral:");
    EXPECT_LT(example, help.find("\n  ")) << help;
    EXPECT_LT(general, help.find("--help")) << help;
    EXPECT_LT(help.rfind("\n\n"), general) << help;
  }
  EXPECT_LE(WidestLine(Call({"--help"}).out), 80u);
}

TEST_F(OnTerminal, WordsAreBrokenAtItsWidthAndNowhereElse) {
  WriteLog(600);
  const std::vector<std::vector<std::string>> commands{
      {"check", "log.csv"},
      {"identify", "log.csv", "--identifier", "nominal-ls", "--explain"},
      {"identify", "log.csv", "--set", "law=asymmetric"},
      {"identify", "--help"}};
  for (const std::vector<std::string>& command : commands) {
    const ProgramAnswer shown = On(100, command, {{"TERM", "dumb"}});
    EXPECT_LE(WidestLine(shown.out), 100u) << shown.out;
    const ProgramAnswer piped = Program(command);
    EXPECT_EQ(shown.status, piped.status);
  }
  // a file has each sentence on a line
  const std::vector<std::string> refused{"identify", "log.csv", "--set", "law=asymmetric"};
  const std::string said = Program(refused).err;
  EXPECT_EQ(std::ranges::count(said, '\n'), 1);
  EXPECT_GT(said.size(), 50u);
  EXPECT_EQ(WordsOf(On(50, refused, {{"TERM", "dumb"}}).out), WordsOf(said));
}

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
