#include "tools/terminal/shell_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace warmjoint {
namespace {

using testing::ElementsAre;

TEST(ShellWords, IsSplitAtBlanksOutsideQuotes) {
  EXPECT_THAT(SplitCommand("  python3 me.py\t--x=1 ", {}),
              ElementsAre("python3", "me.py", "--x=1"));
  EXPECT_THAT(SplitCommand("a 'b  c' \"d 'e\" f\\ g ''", {}),
              ElementsAre("a", "b  c", "d 'e", "f g", ""));
  EXPECT_THAT(SplitCommand("a $(b) `c` ; d | e > f", {}),
              ElementsAre("a", "$(b)", "`c`", ";", "d", "|", "e", ">", "f"))
      << "nothing is expanded";
  EXPECT_THROW(SplitCommand("a 'b", {}), BadInput);
}

TEST(ShellWords, JoinsToWhatSplitsToTheSame) {
  const std::vector<std::string> words{"a b",         "it's", "",     "$(x)",
                                       "{recording}", "a\"b", "c\\d", "e\nf"};
  EXPECT_EQ(SplitCommand(JoinCommand(words), {}), words);
  EXPECT_EQ(JoinCommand({"./run.py", "{recording}", "--n=3,4"}), "./run.py {recording} --n=3,4");
  EXPECT_EQ(JoinCommand({"/tmp/{a,b}/run", "{1..3}"}), "'/tmp/{a,b}/run' '{1..3}'");
}

}  // namespace
}  // namespace warmjoint
