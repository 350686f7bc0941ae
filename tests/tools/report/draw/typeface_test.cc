#include "tools/report/draw/typeface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace warmjoint::report {
namespace {

using ::testing::ElementsAre;

constexpr Type kType{12};

TEST(Typeface, MeasuresLinesByTheirWidestAndTheirNumber) {
  const Extent one = Measure("wide words", kType);
  const Extent two = Measure("wide words\nw", kType);
  EXPECT_EQ(two.width, one.width);
  EXPECT_EQ(two.height, 24);
  EXPECT_NEAR(Measure("wide words", {24}).width, 2 * one.width, 1e-9) << "proportional";
  EXPECT_GT(Measure("wide words", {12, true}).width, one.width);
}

TEST(Typeface, BreaksBetweenWordsAndInsideOfWhatIsTooWide) {
  const double wide = Measure("abc def", kType).width + 0.01;
  EXPECT_THAT(LinesOf("abc def ghi", kType, wide), ElementsAre("abc def", "ghi"));
  EXPECT_THAT(LinesOf("a\nb", kType, wide), ElementsAre("a", "b"));
  // letters of two bytes stay whole
  const double two = Measure("ää", kType).width + 0.01;
  EXPECT_THAT(LinesOf("äääää", kType, two), ElementsAre("ää", "ää", "ä"));
}

TEST(Typeface, LowersWhatStandsInBraces) {
  const auto runs = RunsOf("k_{v} |v|", kType);
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[0].text, "k");
  EXPECT_EQ(runs[1].text, "v");
  EXPECT_LT(runs[1].type.size, kType.size);
  EXPECT_GT(runs[1].drop, 0);
  EXPECT_EQ(runs[2].text, " |v|");
  EXPECT_NEAR(runs[2].left, runs[0].width + runs[1].width, 1e-12);
  EXPECT_EQ(RunsOf("open_{ended", kType).size(), 1u);
}

TEST(Typeface, SaysWhatItCannotSetAndSetsItNevertheless) {
  EXPECT_TRUE(CanSet("τ ≤ 5·10⁻³ N·m", kType));
  EXPECT_FALSE(CanSet("\u4E2D", kType));
  EXPECT_FALSE(CanSet("\xFF", kType)) << "no UTF-8";
  EXPECT_GT(Measure("\xFF", kType).width, 0);
  EXPECT_GT(Measure("after", kType).width, 0) << "goes on";
}

}  // namespace
}  // namespace warmjoint::report
