#include "models/foundation/parse_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace warmjoint {
namespace {

TEST(ParseNumber, ReadsWholeNumbersFractionsAndExponents) {
  EXPECT_EQ(ParseNumber("5"), 5.0);
  EXPECT_EQ(ParseNumber(" -2.5e-3\t"), -2.5e-3);
  EXPECT_EQ(ParseNumber("+1"), 1.0);
  EXPECT_TRUE(std::isnan(*ParseNumber("nan")));
  EXPECT_EQ(ParseNumber("inf"), std::numeric_limits<double>::infinity());
}

TEST(ParseNumber, RefusesWhatIsLeftOver) {
  for (const char* text : {"", " ", "5x", "5 6", "1,5", "--1", "+-1", "0x10", "1e999", "five"}) {
    EXPECT_FALSE(ParseNumber(text).has_value()) << '\'' << text << '\'';
  }
}

TEST(ParseNumber, TakesWhatIsTooSmallForNext) {
  EXPECT_EQ(ParseNumber("1e-400"), 0.0);
  EXPECT_EQ(ParseNumber("-1e-400"), -0.0);
  EXPECT_EQ(ParseNumber("1e-310"), 1e-310) << "denormal";
  EXPECT_FALSE(ParseNumber("-1e400"));
}

TEST(ParseUnsigned, DoesNotWrapRound) {
  EXPECT_EQ(ParseUnsigned("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  for (const char* text : {"-1", "18446744073709551616", "1.5", "1e3", ""}) {
    EXPECT_FALSE(ParseUnsigned(text).has_value()) << '\'' << text << '\'';
  }
}

TEST(ParseInteger, RefusesFractionsAndOverflow) {
  EXPECT_EQ(ParseInteger("-42"), -42);
  for (const char* text : {"1.5", "1e3", "9223372036854775808", ""}) {
    EXPECT_FALSE(ParseInteger(text).has_value()) << '\'' << text << '\'';
  }
}

}  // namespace
}  // namespace warmjoint
