#include "models/foundation/excerpt.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

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
  EXPECT_EQ(Excerpt(std::string_view("a\x1b[31m\n\0b", 9)), "a?[31m??b");
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
