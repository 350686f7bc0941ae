#include "models/foundation/excerpt.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

TEST(Utf8, ReadsCharactersOfEveryLength) {
  EXPECT_EQ(FirstCharacter("a").code, U'a');
  EXPECT_EQ(FirstCharacter("\u00e4b").code, U'\u00e4');
  EXPECT_EQ(FirstCharacter("\u4e2d").length, 3u);
  EXPECT_EQ(FirstCharacter("\U0010FFFF").code, U'\U0010FFFF');
}

TEST(Utf8, FindsTheFirstByteThatIsNone) {
  EXPECT_FALSE(FirstBrokenByte("a\u00e4\u4e2d\U0001F600"));
  EXPECT_EQ(FirstBrokenByte("ab\xCF"), 2u) << "cut off";
  EXPECT_EQ(FirstBrokenByte("\x80"), 0u) << "goes on with nothing";
  EXPECT_EQ(FirstBrokenByte("a\xC0\xAF"), 1u) << "longer than need be";
  EXPECT_EQ(FirstBrokenByte("\xED\xA0\x80"), 0u) << "half of a pair";
  EXPECT_EQ(FirstBrokenByte(std::string_view("a\0b", 3)), 1u) << "a zero byte";
}

TEST(Excerpt, ShowsShortTextWhole) {
  EXPECT_EQ(Excerpt(""), "");
  EXPECT_EQ(Excerpt("0,5"), "0,5");
  EXPECT_EQ(Excerpt(std::string(60, 'a')), std::string(60, 'a'));
}

TEST(Excerpt, CutsLongTextAfter60Characters) {
  EXPECT_EQ(Excerpt(std::string(61, 'a')), std::string(60, 'a') + "...");
  EXPECT_EQ(Excerpt(std::string(1 << 20, 'a')).size(), 63u);
}

TEST(Excerpt, CutsNoCharacterInTwo) {
  std::string umlauts;
  for (int i = 0; i < 70; ++i) umlauts += "ä";
  EXPECT_EQ(Excerpt(umlauts), umlauts.substr(0, 120) + "...");
}

TEST(Excerpt, LetsNothingControlTheTerminal) {
  EXPECT_EQ(Excerpt(std::string_view("a\x1b[31m\n\0b", 9)), "a\\x1B[31m\\x0A\\x00b");
  EXPECT_EQ(Excerpt("\u009b31m"), "\\u009B31m") << "one character that is CSI to some terminals";
  EXPECT_EQ(Excerpt("gpj.\u202Egnp"), "gpj.\\u202Egnp") << "turns the writing round";
  EXPECT_EQ(Excerpt("\u2066x\u2069\u2028"), "\\u2066x\\u2069\\u2028");
}

TEST(Excerpt, ShowsBytesThatAreNoTextAsCodes) {
  EXPECT_EQ(Excerpt("\xCF"), "\\xCF");
  EXPECT_EQ(Excerpt("a\xC0\x80z"), "a\\xC0\\x80z") << "a zero, longer than need be";
  EXPECT_EQ(Excerpt("\xED\xA0\x80"), "\\xED\\xA0\\x80") << "half of a pair";
  EXPECT_EQ(Excerpt("\xF4\x90\x80\x80"), "\\xF4\\x90\\x80\\x80") << "beyond the last character";
  EXPECT_EQ(Excerpt("\u00e4\u4e2d\U0001F600"), "\u00e4\u4e2d\U0001F600");
}

TEST(Excerpt, IsBoundedForBytesThatAreNoText) {
  EXPECT_LE(Excerpt(std::string(1000, '\x80')).size(), 243u);
}

TEST(ExcerptOfList, CountsWhatItLeavesOut) {
  EXPECT_EQ(ExcerptOfList({"time", "torque"}), "time, torque");
  const std::string many = ExcerptOfList(std::vector<std::string>(1000, "c"));
  EXPECT_EQ(many.substr(many.size() - 17), "c, c and 976 more");
}

}  // namespace
}  // namespace warmjoint
