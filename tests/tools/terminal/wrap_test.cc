#include "tools/terminal/wrap.h"

#include <gmock/gmock.h>

namespace warmjoint {
namespace {

using testing::ElementsAre;

TEST(WrapLine, BreaksAtBlanksAndLeavesLongWordsWhole) {
  EXPECT_THAT(WrapLine("one two three", 7), ElementsAre("one two", "three"));
  EXPECT_THAT(WrapLine("a incomprehensible b", 5), ElementsAre("a", "incomprehensible", "b"));
  EXPECT_THAT(WrapLine("", 5), ElementsAre(""));
}

TEST(Wrap, LeavesLinesThatFitAsTheyAre) {
  const std::string text = "a  b\n\n   c   d\n";
  EXPECT_EQ(Wrap(text, 10), text);
  EXPECT_EQ(Wrap("no end", 10), "no end");
}

TEST(Wrap, HangsWhatIsLeftOfALineBehindItsOwnMargin) {
  EXPECT_EQ(Wrap("  one two three four\n", 11, 2), "  one two\n    three\n    four\n");
  EXPECT_EQ(Wrap("one two three", 7, 0), "one two\nthree");
}

TEST(Wrap, HoldsTheWidthForEveryWidth) {
  const std::string text =
      "  the friction of a joint depends on its own heat, and on nothing else\n";
  for (int width = 20; width < 80; ++width) {
    for (const std::string& line : Lines(Wrap(text, width))) EXPECT_LE(ShownWidth(line), width);
  }
}

TEST(ShownWidth, CountsCharactersAndNoColours) {
  EXPECT_EQ(ShownWidth("Cramér"), 6);
  EXPECT_EQ(ShownWidth("\033[1;32mok\033[0m"), 2);
}

TEST(CutToWidth, ShowsThatSomethingIsLeftOut) {
  EXPECT_EQ(CutToWidth("12345678", 8), "12345678");
  EXPECT_EQ(CutToWidth("123456789", 8), "12345...");
  EXPECT_EQ(CutToWidth("ééééééééé", 8), "ééééé...");
  EXPECT_EQ(CutToWidth("12345", 2), "..");
}

TEST(CutToWidth, CountsNoColoursAndEndsThem) {
  EXPECT_EQ(CutToWidth("\033[1;32m123456789\033[0m", 8), "\033[1;32m12345...\033[0m");
}

}  // namespace
}  // namespace warmjoint
