#include "models/foundation/utf8.h"

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

}  // namespace
}  // namespace warmjoint
