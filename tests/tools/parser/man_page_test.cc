#include "tools/parser/man_page.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/parser/example_tree.h"
#include "tests/tools/scratch_directory.h"
#include "tools/terminal/wrap.h"

namespace warmjoint {
namespace {

using testing::HasSubstr;

bool IsThere(const std::string& program) {
  return RunCommandLine({"sh", "-c", "command -v " + program}).status == 0;
}

TEST(ManPage, WritesWordsThatRoffTakesAsTheyAre) {
  const ExampleParser parser;
  const CommandNode tree = ReadTree(parser.app);
  const std::string page = ManPage(tree.commands[0], "warmjoint", "warmjoint 1");
  EXPECT_THAT(page, HasSubstr("warmjoint\\-brew \\- Make a \\ecup: tea [green] or coffee\n"));
  EXPECT_THAT(page, HasSubstr("\\fB\\-o\\fR, \\fB\\-\\-output\\fR \\fIFILE\\fR\n"));
  EXPECT_EQ(ManName(tree, ""), "warmjoint");
}

class ManPages : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(RunWarmjoint({"man", "-o", folder_}).status, 0);
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      pages_.push_back(entry.path());
    }
    ASSERT_GE(pages_.size(), 15u);
  }

  ScratchDirectory scratch_;
  std::string folder_ = scratch_.path() / "man1";
  std::vector<std::string> pages_;
};

TEST_F(ManPages, AreFormattedWithoutAWarning) {
  if (!IsThere("groff")) GTEST_SKIP() << "groff is absent";
  for (const std::string& page : pages_) {
    const ProgramAnswer answer = RunCommandLine({"groff", "-ww", "-z", "-man", "-Tutf8", page});
    EXPECT_EQ(answer.status, 0) << page;
    EXPECT_EQ(answer.err, "") << page;
  }
}

TEST_F(ManPages, PassTheChecksOfMandoc) {
  if (!IsThere("mandoc")) GTEST_SKIP() << "mandoc is absent";
  for (const std::string& page : pages_) {
    const ProgramAnswer answer = RunCommandLine({"mandoc", "-Tlint", "-Wwarning", page});
    // pages bear no date, so that the same source makes the same bytes
    for (const std::string& complaint : Lines(answer.out + answer.err)) {
      EXPECT_THAT(complaint, HasSubstr("missing date"));
    }
  }
}

TEST_F(ManPages, ShowEveryOptionToMan) {
  if (!IsThere("man")) GTEST_SKIP() << "man is absent";
  const ProgramAnswer shown =
      RunCommandLine({"man", "-l", folder_ + "/warmjoint-identify.1"},
                     {{}, {{"MANWIDTH", "80"}, {"MAN_KEEP_FORMATTING", ""}}});
  EXPECT_EQ(shown.status, 0) << shown.err;
  const ProgramAnswer help = RunWarmjoint({"help", "identify"});
  for (const char* option : {"--map", "--identifier", "--explain", "--output"}) {
    EXPECT_THAT(shown.out, HasSubstr(option));
    EXPECT_THAT(help.out, HasSubstr(option));
  }
}

}  // namespace
}  // namespace warmjoint
